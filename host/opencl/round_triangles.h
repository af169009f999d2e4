// The triangles whose corners the sphericity term compares, as kernels/shared/triangle.h sees them.
#pragma once

#include "swage/steps.h"

namespace swage {

struct RoundTriangles {
  /// Axis, cosines, sines, three unit sides, sphericity weight: so far of directions. Then 1 over the sides' lengths.
  static constexpr int kOfDirections = 19, kAll = 22;

  Eigen::VectorXi triangles;
  Eigen::Matrix<int, Eigen::Dynamic, 3> corners;  ///< Their vertices.
  Eigen::Matrix<double, Eigen::Dynamic, kAll> rest;
};

RoundTriangles round_triangles(const TransformStep::Rest& rest);

}  // namespace swage
