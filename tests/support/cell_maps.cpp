#include "cell_maps.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>

#include "carry.h"

namespace swage::test {
namespace {

constexpr double kUntouched = 0.1;

template <typename Work>
void each_cell(const GridShape& shape, const Work& work) {
  for (int k = 0; k < shape.cells[2]; ++k) {
    for (int j = 0; j < shape.cells[1]; ++j) {
      for (int i = 0; i < shape.cells[0]; ++i) {
        work(shape.cells.at(i, j, k), Eigen::RowVector3d(i + 0.5, j + 0.5, k + 0.5));
      }
    }
  }
}

/// The surface of a ball, or of a roll about `axis` so many cells long; its parts in cells, its centre of the grid's.
struct Round {
  Eigen::RowVector3d centre;
  double radius;
  int axis = -1;
  double half_length = 0;
};

void touch(const GridShape& shape, const Round& round, CellMap& map) {
  each_cell(shape, [&](Eigen::Index c, const Eigen::RowVector3d& middle) {
    Eigen::RowVector3d off = middle;
    for (int u = 0; u < 3; ++u) off[u] -= round.centre[u] * shape.cells[u];
    if (round.axis >= 0) {
      if (std::abs(off[round.axis]) > round.half_length) return;
      off[round.axis] = 0;
    }
    if (std::abs(off.norm() - round.radius) > 0.9) return;
    map.phi[c] = 1;
    for (int u = 0; u < 3; ++u) {
      if (u == round.axis) continue;
      map.theta(c, u) = std::max(map.theta(c, u), std::min(1.0, 10 * std::abs(off[u]) / off.norm()));
    }
  });
}

void add_wall(const GridShape& shape, int axis, double at, CellMap& map) {
  each_cell(shape, [&](Eigen::Index c, const Eigen::RowVector3d& middle) {
    if (std::floor(middle[axis]) != std::floor(at * shape.cells[axis])) return;
    map.phi[c] = 1;
    map.theta(c, axis) = std::max(map.theta(c, axis), 1e-4);
  });
}

}  // namespace

GridShape unit_cells(int x, int y, int z) {
  return {{{x, y, z}}, Eigen::RowVector3d::Zero(), Eigen::RowVector3d(x, y, z)};
}

CellMap free_map(const GridShape& shape) {
  const Eigen::Index count = shape.cells.count();
  return {AxisValues::Zero(count, 3), Eigen::VectorXd::Constant(count, kUntouched)};
}

CellMap protected_map(const GridShape& shape) {
  const Eigen::Index count = shape.cells.count();
  return {AxisValues::Ones(count, 3), Eigen::VectorXd::Ones(count)};
}

CellMap checkered_map(const GridShape& shape) {
  CellMap map = free_map(shape);
  each_cell(shape, [&](Eigen::Index c, const Eigen::RowVector3d& middle) {
    if (std::lround(middle.sum() - 1.5) % 2 == 0) return;
    map.theta.row(c).setOnes();
    map.phi[c] = 1;
  });
  return map;
}

CellMap one_cell_map(const GridShape& shape) {
  CellMap map = free_map(shape);
  const Eigen::Index c = shape.cells.at(shape.cells[0] / 2, shape.cells[1] / 2, shape.cells[2] / 2);
  map.theta.row(c).setOnes();
  map.phi[c] = 1;
  return map;
}

CellMap random_map(const GridShape& shape, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(0, 1);
  CellMap map = free_map(shape);
  for (Eigen::Index c = 0; c < map.phi.size(); ++c) {
    for (int u = 0; u < 3; ++u) map.theta(c, u) = std::max(0.0, 2 * part(random) - 1);
    map.phi[c] = part(random) < 0.5 ? 1 : kUntouched;
  }
  return map;
}

CellMap car_map(const GridShape& shape) {
  CellMap map = free_map(shape);
  const double x = shape.cells[0], z = shape.cells[2], size = std::min<double>(shape.cells[1], z);
  for (const double front : {0.2, 0.8}) {
    for (const double side : {0.1, 0.9}) touch(shape, {{front, 0.2, side}, 0.15 * size, 2, 0.08 * z}, map);
  }
  touch(shape, {{0.5, 0.55, 0.5}, 0.3 * size}, map);
  touch(shape, {{0.3, 0.8, 0.5}, 0.1 * size}, map);
  touch(shape, {{0.7, 0.75, 0.3}, 0.12 * size, 0, 0.1 * x}, map);
  add_wall(shape, 1, 0.35, map);
  for (const double at : {0.02, 0.97}) add_wall(shape, 0, at, map);
  for (const double at : {0.05, 0.94}) add_wall(shape, 2, at, map);
  return map;
}

CellMap ball_map(const GridShape& shape, double radius) {
  CellMap map = free_map(shape);
  const double size = std::min({shape.cells[0], shape.cells[1], shape.cells[2]});
  touch(shape, {{0.5, 0.5, 0.5}, radius * size}, map);
  return map;
}

double determinant(const GridShape& shape, const AxisValues& vertices, const Eigen::RowVector3d& at,
                   const Eigen::RowVector3i& cell, const Eigen::RowVector3d& factors) {
  constexpr double kStep = 1e-3;
  Positions points(6, 3);
  for (int u = 0; u < 3; ++u) {
    for (int side = 0; side < 2; ++side) {
      Eigen::RowVector3d part = at * (1 - 2 * kStep) + Eigen::RowVector3d::Constant(kStep);
      part[u] += side == 0 ? -kStep : kStep;
      points.row(2 * u + side) = ((cell.cast<double>() + part).array() * shape.size.array() /
                                  Eigen::RowVector3d(shape.cells[0], shape.cells[1], shape.cells[2]).array()) +
                                 shape.corner.array();
    }
  }
  const Positions moved = carry(shape, vertices, points);
  Eigen::Matrix3d jacobian;
  for (int u = 0; u < 3; ++u) {
    jacobian.row(u) = (moved.row(2 * u + 1) - moved.row(2 * u)) / (points(2 * u + 1, u) - points(2 * u, u));
    jacobian.row(u).array() /= factors.array();
  }
  return jacobian.determinant();
}

}  // namespace swage::test
