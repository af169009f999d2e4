#include "coverage.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace swage {
namespace {

using Eigen::Matrix3d;
using Eigen::RowVector3d;

constexpr double kGrazing = 1e-9;  // Cells.

/// Whether the projections of the triangle and of the cube about the origin, of half a side 0.5, onto the axis meet.
bool meet_along(const Matrix3d& corners, const RowVector3d& axis) {
  const Eigen::Vector3d at = corners * axis.transpose();
  const double reach = (0.5 + kGrazing) * axis.cwiseAbs().sum();
  return at.minCoeff() <= reach && at.maxCoeff() >= -reach;
}

/// Separating axes: the faces' normals, the triangle's, and the products of their edges.
bool meet(const Matrix3d& corners) {
  Matrix3d sides;
  for (int k = 0; k < 3; ++k) sides.row(k) = corners.row((k + 1) % 3) - corners.row(k);
  if (!meet_along(corners, sides.row(0).cross(sides.row(1)))) return false;
  for (int u = 0; u < 3; ++u) {
    if (!meet_along(corners, RowVector3d::Unit(u))) return false;
    for (int k = 0; k < 3; ++k) {
      if (!meet_along(corners, RowVector3d::Unit(u).cross(sides.row(k)))) return false;
    }
  }
  return true;
}

std::vector<int> cells_of(const GridShape& shape, Matrix3d corners) {
  std::array<int, 3> first = {}, last = {};
  for (int u = 0; u < 3; ++u) {
    if (!shape.extends(u)) {
      corners.col(u).setConstant(0.5);
      continue;
    }
    corners.col(u) = (corners.col(u).array() - shape.corner[u]) / shape.size[u] * shape.cells[u];
    const auto cell = [&](double at) { return std::clamp(static_cast<int>(std::floor(at)), 0, shape.cells[u] - 1); };
    first[static_cast<size_t>(u)] = cell(corners.col(u).minCoeff() - kGrazing);
    last[static_cast<size_t>(u)] = cell(corners.col(u).maxCoeff() + kGrazing);
  }
  std::vector<int> cells;
  for (int k = first[2]; k <= last[2]; ++k) {
    for (int j = first[1]; j <= last[1]; ++j) {
      for (int i = first[0]; i <= last[0]; ++i) {
        const RowVector3d middle(i + 0.5, j + 0.5, k + 0.5);
        if (meet(corners.rowwise() - middle)) cells.push_back(static_cast<int>(shape.cells.at(i, j, k)));
      }
    }
  }
  return cells;
}

}  // namespace

Coverage coverage(const GridShape& shape, const PositionsRef& positions, const TrianglesRef& triangles, const Backend&,
                  const Poll& poll) {
  Coverage result{{0}, {}};
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    ask(poll);
    Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.row(k) = positions.row(triangles(t, k));
    const std::vector<int> cells = cells_of(shape, corners);
    result.cells.insert(result.cells.end(), cells.begin(), cells.end());
    result.offsets.push_back(static_cast<Eigen::Index>(result.cells.size()));
  }
  return result;
}

}  // namespace swage
