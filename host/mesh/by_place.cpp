#include "by_place.h"

#include <algorithm>
#include <numeric>

namespace swage {
namespace {

std::vector<int> ascending(const Eigen::VectorXd& keys) {
  std::vector<int> order(static_cast<size_t>(keys.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return keys[a] < keys[b]; });
  return order;
}

/// Solutions of x = cos x and x = exp(-x): no small whole numbers relate them.
Eigen::VectorXd along(const Positions& points) {
  return points * Eigen::Vector3d(1, 0.7390851332151607, 0.5671432904097838);
}

}  // namespace

std::vector<int> by_place(const Positions& points) { return ascending(along(points)); }

Numbering by_place(const Mesh& mesh) {
  const Eigen::VectorXd places = along(mesh.positions);
  const auto corner = [&](int k) { return places(mesh.triangles.col(k)); };
  return {ascending(places), ascending(corner(0) + corner(1) + corner(2))};
}

void begin_with_first(Triangles& triangles) {
  for (auto corners : triangles.rowwise()) {
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  }
}

Positions rounded(const Positions& points) {
  constexpr double kLattice = 0x1p-40;
  Positions result = (points / kLattice).array().round() * kLattice;
  const std::vector<int> order = by_place(result);
  for (size_t i = 1; i < order.size(); ++i) {
    if (result.row(order[i]) == result.row(order[i - 1])) return points;
  }
  return result;
}

}  // namespace swage
