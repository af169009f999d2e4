// The point of a triangle that is closest to another point.
#pragma once

#include <Eigen/Core>
#include <limits>

#include "swage/mesh.h"

namespace swage {

struct Foot {
  int triangle = -1;  ///< -1 for none.
  Eigen::Vector3d barycentric = Eigen::Vector3d::Zero();
  double squared_distance = std::numeric_limits<double>::infinity();

  /// Nearer, or as near on a lower triangle.
  bool operator<(const Foot& other) const {
    if (squared_distance != other.squared_distance) return squared_distance < other.squared_distance;
    return triangle < other.triangle;
  }
};

Foot foot_on(const Mesh& mesh, int triangle, const Eigen::Vector3d& point);

/// The point with these coordinates in the triangle of these vertices.
inline Eigen::RowVector3d point_at(const PositionsRef& positions, const Eigen::RowVector3i& corners,
                                   const Eigen::Vector3d& barycentric) {
  return barycentric[0] * positions.row(corners[0]) + barycentric[1] * positions.row(corners[1]) +
         barycentric[2] * positions.row(corners[2]);
}

}  // namespace swage
