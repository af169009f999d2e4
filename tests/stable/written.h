// The same problem written down in other ways: in other units, elsewhere, in another order.
#pragma once

#include <string>
#include <vector>

#include "swage/handles.h"
#include "swage/mesh.h"

namespace swage::test {

/// Of a mesh whose D is about 1.
struct Writing {
  std::string name;
  double scale = 1;
  double offset = 0;  ///< Along all axes, before scaling.
  unsigned seed = 0;  ///< Of an order of vertices, triangles and corners; 0 keeps that given.
};

/// As given, and in other ways: smaller and larger, moved, in other orders, and all of it.
const std::vector<Writing>& other_writings();

class Written {
 public:
  explicit Written(const Mesh& mesh, const Writing& by = {});

  const Mesh& mesh() const { return mesh_; }
  double scale() const { return by_.scale; }
  Eigen::Vector3d into(const Eigen::Vector3d& point) const;
  Gesture into(const Gesture& gesture) const;
  std::vector<int> into(std::vector<int> vertices) const;
  /// In the order given.
  Positions in_order(const Positions& rows) const { return rows(place_, Eigen::all); }
  /// And where, in its units.
  Positions back(const Positions& positions) const;

 private:
  Writing by_;
  std::vector<int> place_;  ///< Of each vertex given.
  Mesh mesh_;
};

}  // namespace swage::test
