// Where a surface is nearest to a point.
#pragma once

#include <functional>
#include <vector>

#include "box_tree.h"
#include "swage/mesh.h"

namespace swage {

/// A point of a triangle.
struct Foot {
  int triangle = -1;
  Eigen::Vector3d barycentric = Eigen::Vector3d::Zero();  ///< None negative, of sum 1.
  double distance = 0;
};

/// The point of triangle abc that is nearest to p; of one without area too.
Foot nearest_on_triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                         const Eigen::Vector3d& c);

/// Triangles by where they are. Borrows the mesh.
class TriangleTree {
 public:
  TriangleTree(const Positions& positions, const Triangles& triangles);
  TriangleTree(const TriangleTree&) = delete;
  TriangleTree& operator=(const TriangleTree&) = delete;

  /// The nearest point of the triangles that `counts`, no farther than `most`; of several the one of the lowest number.
  Foot nearest(const Eigen::Vector3d& point, double most, const std::function<bool(int)>& counts) const;
  Foot nearest(const Eigen::Vector3d& point) const;

  /// Of all triangles that are nearest, to a tolerance, ascending.
  std::vector<Foot> all_nearest(const Eigen::Vector3d& point, double tolerance) const;

  /// Calls `found` with each triangle whose box meets `box`.
  void near(const Eigen::AlignedBox3d& box, const std::function<void(int)>& found) const { tree_.overlaps(box, found); }

 private:
  Foot foot_on(int triangle, const Eigen::Vector3d& point) const;

  const Positions& positions_;
  const Triangles& triangles_;
  std::vector<Eigen::AlignedBox3d> boxes_;
  BoxTree tree_;
};

}  // namespace swage
