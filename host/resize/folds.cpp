#include "folds.h"

#include <Eigen/LU>
#include <algorithm>

#include "merge.h"

namespace swage {
namespace {

using Eigen::Index;
using Corner = std::array<int, 3>;

/// The edges of a cell along each axis, in units of their length at rest, by the place of their first corner.
struct CellEdges {
  CellEdges(const GridShape& shape, const AxisValues& vertices, const Corner& cell) {
    const Extents grid = shape.vertices();
    for (int u = 0; u < 3; ++u) {
      for (int corner = 0; corner < 8; ++corner) {
        Corner at = {corner & 1, corner >> 1 & 1, corner >> 2};
        if (at[static_cast<size_t>(u)] == 1) continue;
        Eigen::RowVector3d& edge = edges[static_cast<size_t>(u)][static_cast<size_t>(corner)];
        edge = Eigen::RowVector3d::Unit(u);
        if (!shape.extends(u)) continue;
        for (size_t axis = 0; axis < 3; ++axis) at[axis] += cell[axis];
        const Index first = grid.at(at[0], at[1], at[2]);
        for (int v = 0; v < 3; ++v) {
          const double off = vertices(first + grid.stride(u), v) - vertices(first, v);
          edge[v] = shape.extends(v) ? off * shape.cells[v] / shape.size[v] : 0;
        }
      }
    }
  }
  const Eigen::RowVector3d& along(int u, int i, int j, int k) const {
    const int corner = i + 2 * j + 4 * k;
    return edges[static_cast<size_t>(u)][static_cast<size_t>(corner)];
  }

  std::array<std::array<Eigen::RowVector3d, 8>, 3> edges;
};

/// A bound of the determinant that is quickly had.
bool surely_above(const CellEdges& cell, double least) {
  Eigen::Matrix3d most = Eigen::Matrix3d::Zero();
  Eigen::Vector3d shortest = Eigen::Vector3d::Constant(1e300);
  for (int u = 0; u < 3; ++u) {
    for (int corner = 0; corner < 8; ++corner) {
      if ((corner >> u & 1) == 1) continue;
      const Eigen::RowVector3d& edge = cell.edges[static_cast<size_t>(u)][static_cast<size_t>(corner)];
      shortest[u] = std::min(shortest[u], edge[u]);
      most.row(u) = most.row(u).cwiseMax(edge.cwiseAbs());
    }
  }
  if (shortest.minCoeff() <= 0) return false;
  const double turns = most(0, 1) * most(1, 2) * most(2, 0) + most(0, 2) * most(1, 0) * most(2, 1) +
                       most(0, 0) * most(1, 2) * most(2, 1) + most(1, 1) * most(0, 2) * most(2, 0) +
                       most(2, 2) * most(0, 1) * most(1, 0);
  return shortest.prod() - turns > least;
}

double least_coefficient(const CellEdges& cell) {
  Eigen::Array<double, 27, 1> sums = Eigen::Array<double, 27, 1>::Zero();
  for (int choice = 0; choice < 64; ++choice) {
    const auto bit = [&](int i) { return choice >> i & 1; };
    Eigen::Matrix3d jacobian;
    jacobian << cell.along(0, 0, bit(0), bit(1)), cell.along(1, bit(2), 0, bit(3)), cell.along(2, bit(4), bit(5), 0);
    const std::array<int, 3> place = {bit(2) + bit(4), bit(0) + bit(5), bit(1) + bit(3)};
    double weight = 1;
    for (const int p : place) weight *= p == 1 ? 0.5 : 1;
    sums[place[0] + 3 * place[1] + 9 * place[2]] += weight * jacobian.determinant();
  }
  return sums.minCoeff();
}

}  // namespace

std::vector<Index> folded_cells(const GridShape& shape, const AxisValues& vertices, double least) {
  std::vector<char> folded(static_cast<size_t>(shape.cells.count()), 0);
#pragma omp parallel for schedule(static) if (shape.cells.count() > kManyEntries)
  for (int k = 0; k < shape.cells[2]; ++k) {
    for (int j = 0; j < shape.cells[1]; ++j) {
      for (int i = 0; i < shape.cells[0]; ++i) {
        const CellEdges cell(shape, vertices, {i, j, k});
        if (!surely_above(cell, least) && least_coefficient(cell) < least) {
          folded[static_cast<size_t>(shape.cells.at(i, j, k))] = 1;
        }
      }
    }
  }
  std::vector<Index> cells;
  for (size_t c = 0; c < folded.size(); ++c) {
    if (folded[c] != 0) cells.push_back(static_cast<Index>(c));
  }
  return cells;
}

}  // namespace swage
