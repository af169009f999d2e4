#include "carry.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "swage/error.h"

namespace swage {

Positions carry(const GridShape& shape, const AxisValues& vertices, const PositionsRef& points) {
  const Extents grid = shape.vertices();
  if (vertices.rows() != grid.count()) throw InvalidInput("carry: vertices: not a row for each vertex of the grid");
  if (!points.allFinite()) throw InvalidInput("carry: points: not finite");
  Positions result(points.rows(), 3);
#pragma omp parallel for schedule(static) if (points.rows() > 1000)
  for (Eigen::Index p = 0; p < points.rows(); ++p) {
    std::array<int, 3> cell = {};
    Eigen::RowVector3d part = Eigen::RowVector3d::Zero(), off = Eigen::RowVector3d::Zero();
    for (int u = 0; u < 3; ++u) {
      if (!shape.extends(u)) {
        off[u] = points(p, u) - shape.corner[u];
        continue;
      }
      const double at = (points(p, u) - shape.corner[u]) / shape.size[u] * shape.cells[u];
      cell[static_cast<size_t>(u)] = static_cast<int>(std::clamp(std::floor(at), 0.0, shape.cells[u] - 1.0));
      part[u] = at - cell[static_cast<size_t>(u)];
    }
    Eigen::RowVector3d sum = off;
    for (int corner = 0; corner < 8; ++corner) {
      const int i = corner & 1, j = corner >> 1 & 1, k = corner >> 2;
      const double weight =
          (i == 1 ? part[0] : 1 - part[0]) * (j == 1 ? part[1] : 1 - part[1]) * (k == 1 ? part[2] : 1 - part[2]);
      sum += weight * vertices.row(grid.at(cell[0] + i, cell[1] + j, cell[2] + k));
    }
    result.row(p) = sum;
  }
  return result;
}

}  // namespace swage
