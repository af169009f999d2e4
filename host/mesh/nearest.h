// Where a surface is nearest to a point.
#pragma once

#include <functional>
#include <vector>

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

/// A tree of boxes around triangles.
class BoxTree {
 public:
  struct Box {
    Eigen::Vector3d low = Eigen::Vector3d::Zero(), high = Eigen::Vector3d::Zero();
    double distance(const Eigen::Vector3d& point) const {
      return (low - point).cwiseMax(point - high).cwiseMax(0).norm();
    }
    bool meets(const Box& other) const {
      return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
    }
  };

  BoxTree(const Positions& positions, const Triangles& triangles);

  /// The nearest point of the triangles that `counts`, nearer than `most`; of several the one of the lowest number.
  Foot nearest(const Eigen::Vector3d& point, double most, const std::function<bool(int)>& counts) const;
  Foot nearest(const Eigen::Vector3d& point) const;

  /// Calls `visit` with each triangle whose box meets `box`.
  void visit(const Box& box, const std::function<void(int)>& visit) const;

 private:
  struct Node {
    Box box;
    int first, end;  ///< Of `order_`.
    int below = -1;  ///< The first of two children, or -1.
  };
  void build(int node);
  const Positions& positions_;
  const Triangles& triangles_;
  std::vector<int> order_;
  std::vector<Box> boxes_;
  std::vector<Node> nodes_;
};

}  // namespace swage
