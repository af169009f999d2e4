// Handles as a solve takes them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "measures.h"
#include "swage/handles.h"

namespace swage {

/// A point, made of up to three vertices, and where it is held.
struct Hold {
  std::array<int, 3> vertices;
  Eigen::Vector3d factors;  ///< Of sum 1. A vertex by itself is the first, with factor 1.
  Eigen::RowVector3d target;
  double share = 1;  ///< Of the weight of its Holds.

  static Hold at(int vertex, const Eigen::RowVector3d& target, double share = 1) {
    return {{vertex, vertex, vertex}, {1, 0, 0}, target, share};
  }
  /// The vertex with most of the point.
  int vertex() const;
  Eigen::RowVector3d point(const Positions& positions) const;
};

/// A gesture's, each a vertex by itself.
std::vector<Hold> holds_of(const Gesture& gesture);

/// With targets in the unit box.
std::vector<Hold> in_box(std::vector<Hold> holds, const UnitBox& box);

}  // namespace swage
