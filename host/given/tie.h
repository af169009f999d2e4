// What joins components besides triangles.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace swage {

/// Vertices that are joined without a triangle: weight |sum of factor * vertex - rest|². Factors are of sum 0.
struct Tie {
  std::vector<std::pair<int, double>> factors;
  Eigen::RowVector3d rest;
  double weight;
};

}  // namespace swage
