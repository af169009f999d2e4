#include "grid_folds.h"

#include <Eigen/LU>
#include <algorithm>
#include <limits>

namespace swage::test {
namespace {

/// The corners of a cell, in cells of the plainly scaled grid.
Eigen::Matrix<double, 8, 3> corners_of(const GridShape& shape, const AxisValues& vertices, int i, int j, int k) {
  const Extents grid = shape.vertices();
  const Eigen::RowVector3d size = vertices.row(grid.count() - 1) - vertices.row(0);
  Eigen::Matrix<double, 8, 3> corners;
  for (int corner = 0; corner < 8; ++corner) {
    const std::array<int, 3> off = {corner & 1, corner >> 1 & 1, corner >> 2};
    const auto vertex = vertices.row(grid.at(i + off[0], j + off[1], k + off[2]));
    for (int u = 0; u < 3; ++u) {
      corners(corner, u) = shape.extends(u) ? vertex[u] / size[u] * shape.cells[u] : off[static_cast<size_t>(u)];
    }
  }
  return corners;
}

double determinant(const Eigen::Matrix<double, 8, 3>& corners, const Eigen::RowVector3d& at) {
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
  for (int corner = 0; corner < 8; ++corner) {
    for (int u = 0; u < 3; ++u) {
      double slope = 1;
      for (int v = 0; v < 3; ++v) {
        const bool upper = (corner >> v & 1) == 1;
        if (v == u) {
          slope *= upper ? 1 : -1;
        } else {
          slope *= upper ? at[v] : 1 - at[v];
        }
      }
      jacobian.row(u) += slope * corners.row(corner);
    }
  }
  return jacobian.determinant();
}

}  // namespace

double least_determinant(const GridShape& shape, const AxisValues& vertices) {
  double least = std::numeric_limits<double>::infinity();
#pragma omp parallel for reduction(min : least)
  for (int k = 0; k < shape.cells[2]; ++k) {
    for (int j = 0; j < shape.cells[1]; ++j) {
      for (int i = 0; i < shape.cells[0]; ++i) {
        const Eigen::Matrix<double, 8, 3> corners = corners_of(shape, vertices, i, j, k);
        for (int point = 0; point < 27; ++point) {
          const Eigen::RowVector3d at(point % 3, point / 3 % 3, point / 9);
          least = std::min(least, determinant(corners, 0.5 * at));
        }
      }
    }
  }
  return least;
}

}  // namespace swage::test
