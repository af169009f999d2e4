// The protective grid: what it promises at any factor, whatever the map.
#include <gtest/gtest.h>
#include <omp.h>

#include <Eigen/LU>
#include <functional>
#include <random>
#include <string>

#include "assemble.h"
#include "carry.h"
#include "cell_maps.h"
#include "folds.h"
#include "refused.h"
#include "scales.h"
#include "swage/error.h"

namespace swage::test {
namespace {

using Factors = Eigen::RowVector3d;

struct Resized {
  Scales scales;
  GridVertices grid;
};

Resized resized(const GridShape& shape, const CellMap& map, const Factors& factors, double tolerance = 1e-6,
                double size_weight = 0) {
  Resized result;
  result.scales = ScaleSolve(shape, map).solve(factors, {size_weight, tolerance});
  result.grid = Assembly(shape, map).place(result.scales.values, factors, {tolerance});
  EXPECT_TRUE(result.scales.converged);
  EXPECT_TRUE(result.grid.converged);
  return result;
}

struct NamedMap {
  std::string name;
  CellMap map;
};

std::vector<NamedMap> maps(const GridShape& shape) {
  return {{"free", free_map(shape)},         {"protected", protected_map(shape)}, {"checkered", checkered_map(shape)},
          {"one cell", one_cell_map(shape)}, {"random", random_map(shape, 3)},    {"car", car_map(shape)}};
}

void expect_sound(const GridShape& shape, const Resized& result, const Factors& factors) {
  const Extents vertices = shape.vertices();
  const AxisValues& positions = result.grid.positions;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> part(0, 1);
  double least = 1e300, shortest = 1e300, off = 0;
  for (int k = 0; k < vertices[2]; ++k) {
    for (int j = 0; j < vertices[1]; ++j) {
      for (int i = 0; i < vertices[0]; ++i) {
        const Eigen::Index v = vertices.at(i, j, k);
        const std::array<int, 3> at = {i, j, k};
        for (int u = 0; u < 3; ++u) {
          const int along = at[static_cast<size_t>(u)];
          const double size = shape.size[u] * factors[u];
          if (along == 0) off = std::max(off, std::abs(positions(v, u) - shape.corner[u]) / size);
          if (along == shape.cells[u]) off = std::max(off, std::abs(positions(v, u) - shape.corner[u] - size) / size);
          if (along == shape.cells[u]) continue;
          const double edge = positions(v + vertices.stride(u), u) - positions(v, u);
          shortest = std::min(shortest, edge * shape.cells[u] / shape.size[u] / std::min(1.0, factors[u]));
        }
        if (i == shape.cells[0] || j == shape.cells[1] || k == shape.cells[2]) continue;
        for (int n = 0; n < 12; ++n) {
          const Eigen::RowVector3d inside = n < 8 ? Eigen::RowVector3d(n & 1, n >> 1 & 1, n >> 2)
                                                  : Eigen::RowVector3d(part(random), part(random), part(random));
          least = std::min(least, determinant(shape, positions, inside, {i, j, k}, factors));
        }
      }
    }
  }
  EXPECT_GT(least, 0);
  EXPECT_GE(shortest, kLeastEdge * (1 - 1e-9));
  EXPECT_LT(off, 1e-12);
  for (int u = 0; u < 3; ++u) {
    EXPECT_GE(result.scales.values.col(u).minCoeff(), kLeastScale * std::min(1.0, factors[u]) * (1 - 1e-9));
  }
}

TEST(ResizeGrid, IsLeftAloneByFactorsOfOne) {
  const GridShape shape = {{{9, 7, 8}}, {-3, 100, 0.1}, {4, 2.5, 0.3}};
  for (const auto& [name, map] : maps(shape)) {
    SCOPED_TRACE(name);
    const Resized result = resized(shape, map, {1, 1, 1});
    EXPECT_LT((result.grid.positions - rest_vertices(shape)).cwiseAbs().maxCoeff(), 1e-9 * shape.size.norm());
  }
}

TEST(ResizeGrid, ScalesUniformlyByOneFactor) {
  const GridShape shape = {{{9, 7, 8}}, {0, 0, 0}, {4, 2.5, 3}};
  for (const double factor : {0.05, 0.7, 3.0, 20.0}) {
    for (const auto& [name, map] : maps(shape)) {
      SCOPED_TRACE(name);
      const Resized result = resized(shape, map, {factor, factor, factor});
      EXPECT_LT((result.grid.positions - factor * rest_vertices(shape)).cwiseAbs().maxCoeff(),
                1e-6 * factor * shape.size.norm());
    }
  }
}

TEST(ResizeGrid, NeverFoldsAndMeetsTheBox) {
  const GridShape shape = {{{12, 9, 10}}, {-1, 2, 3}, {6, 5, 4}};
  for (const auto& [name, map] : maps(shape)) {
    for (const Factors& factors :
         {Factors(0.05, 1, 1), Factors(1, 0.05, 1), Factors(1, 1, 0.05), Factors(20, 1, 1), Factors(1, 20, 1),
          Factors(1, 1, 20), Factors(2, 1, 1), Factors(1, 0.5, 1), Factors(0.3, 1, 3), Factors(0.05, 20, 1)}) {
      SCOPED_TRACE(name + " by " + std::to_string(factors[0]) + ", " + std::to_string(factors[1]) + ", " +
                   std::to_string(factors[2]));
      expect_sound(shape, resized(shape, map, factors), factors);
    }
  }
}

TEST(ResizeGrid, FoldsWhereOnlyEdgesAreBounded) {
  // Else the test above would not show what keeps cells from it.
  const GridShape shape = unit_cells(24, 16, 15);
  const CellMap map = car_map(shape);
  const Resized result = resized(shape, map, {0.05, 1, 1});
  EXPECT_GT(result.grid.stiffened, 0);
  EXPECT_GT(result.grid.at_bound, 0);
  expect_sound(shape, result, {0.05, 1, 1});
}

TEST(ResizeGrid, GoesTowardsPlainScalingWhereNothingElseHelps) {
  const GridShape shape = unit_cells(24, 24, 24);
  CellMap map = ball_map(shape, 0.52);  // A hollow ball, which has no room beside it.
  map.theta = (map.theta - ball_map(shape, 0.44).theta).cwiseMax(0);
  const Factors factors(0.3, 1, 3);
  Resized result;
  result.scales = ScaleSolve(shape, map).solve(factors, {0, 1e-6});
  result.grid = Assembly(shape, map).place(result.scales.values, factors);
  EXPECT_FALSE(result.grid.converged);
  expect_sound(shape, result, factors);
  // But not all the way.
  const AxisValues plain = (rest_vertices(shape).array().rowwise() * factors.array()).matrix();
  EXPECT_GT((result.grid.positions - plain).cwiseAbs().maxCoeff(), 1);
}

TEST(ResizeGrid, TurnsWithTheModel) {
  const GridShape shape = unit_cells(9, 7, 8);
  const CellMap map = random_map(shape, 5);
  const Factors factors(0.4, 1, 2.5);
  // About z by a quarter: (x, y, z) to (7 - y, x, z).
  const GridShape turned = unit_cells(7, 9, 8);
  CellMap turned_map = free_map(turned);
  for (int k = 0; k < 8; ++k) {
    for (int j = 0; j < 7; ++j) {
      for (int i = 0; i < 9; ++i) {
        const Eigen::Index from = shape.cells.at(i, j, k), to = turned.cells.at(6 - j, i, k);
        turned_map.phi[to] = map.phi[from];
        turned_map.theta.row(to) << map.theta(from, 1), map.theta(from, 0), map.theta(from, 2);
      }
    }
  }
  const AxisValues result = resized(shape, map, factors).grid.positions;
  const AxisValues of_turned = resized(turned, turned_map, {factors[1], factors[0], factors[2]}).grid.positions;
  double off = 0;
  for (int k = 0; k <= 8; ++k) {
    for (int j = 0; j <= 7; ++j) {
      for (int i = 0; i <= 9; ++i) {
        const Eigen::RowVector3d at = result.row(shape.vertices().at(i, j, k));
        const Eigen::RowVector3d due(7 - at[1], at[0], at[2]);
        off = std::max(off, (of_turned.row(turned.vertices().at(7 - j, i, k)) - due).norm());
      }
    }
  }
  EXPECT_LT(off, 1e-5 * shape.size.norm());
}

TEST(ResizeGrid, ScalesABoxPlainly) {
  const GridShape shape = unit_cells(20, 14, 12);
  CellMap map = free_map(shape);
  for (int k = 0; k < 12; ++k) {
    for (int j = 0; j < 14; ++j) {
      for (int i = 0; i < 20; ++i) {
        // Walls at the ends of the grid and one across it, as vulnerable as flat faces are.
        const Eigen::Index c = shape.cells.at(i, j, k);
        const std::array<bool, 3> wall = {i == 0 || i == 19 || i == 7, j == 0 || j == 13, k == 0 || k == 11};
        for (int u = 0; u < 3; ++u) {
          if (!wall[static_cast<size_t>(u)]) continue;
          map.theta(c, u) = 1e-4;
          map.phi[c] = 1;
        }
      }
    }
  }
  for (const Factors& factors : {Factors(2, 1, 1), Factors(1, 0.5, 1), Factors(0.3, 1, 3)}) {
    const AxisValues due = rest_vertices(shape) * factors.asDiagonal();
    const Resized result = resized(shape, map, factors);
    EXPECT_LT((result.grid.positions - due).cwiseAbs().maxCoeff(), 1e-4 * due.row(due.rows() - 1).norm()) << factors;
  }
}

/// How much the longest of a ball's extents exceeds the shortest.
double ring_out_of_round(const GridShape& shape, const AxisValues& vertices, double radius) {
  const Eigen::RowVector3d centre = shape.corner + 0.5 * shape.size;
  Positions ends(6, 3);
  for (int u = 0; u < 3; ++u) {
    ends.row(2 * u) = centre - radius * Eigen::RowVector3d::Unit(u);
    ends.row(2 * u + 1) = centre + radius * Eigen::RowVector3d::Unit(u);
  }
  const Positions moved = carry(shape, vertices, ends);
  Eigen::Vector3d extents;
  for (int u = 0; u < 3; ++u) extents[u] = moved(2 * u + 1, u) - moved(2 * u, u);
  return extents.maxCoeff() / extents.minCoeff() - 1;
}

TEST(ResizeGrid, KeepsABallRound) {
  const GridShape shape = unit_cells(40, 24, 24);
  const double radius = 0.25;
  for (const Factors& factors : {Factors(2, 1, 1), Factors(1, 2, 1), Factors(1, 0.5, 1)}) {
    const Resized result = resized(shape, ball_map(shape, radius), factors);
    EXPECT_LT(ring_out_of_round(shape, result.grid.positions, radius * 24), 0.05) << factors;
  }
}

TEST(ResizeGrid, KeepsTheSizeOfABallWhereAsked) {
  const GridShape shape = unit_cells(40, 24, 24);
  const double radius = 0.2;
  const auto ball_size = [&](double size_weight) {
    const AxisValues vertices = resized(shape, ball_map(shape, radius), {2, 1, 1}, 1e-6, size_weight).grid.positions;
    EXPECT_LT(ring_out_of_round(shape, vertices, radius * 24), 0.05);
    Positions ends(2, 3);
    ends << 20 - radius * 24, 12, 12, 20 + radius * 24, 12, 12;
    const Positions moved = carry(shape, vertices, ends);
    return (moved(1, 0) - moved(0, 0)) / (2 * radius * 24);
  };
  EXPECT_GT(ball_size(0), 1.1);
  EXPECT_NEAR(ball_size(10), 1, 0.02);
}

TEST(ResizeGrid, LeavesOutAxesOfNoExtent) {
  const GridShape flat = {{{12, 1, 9}}, {0, 5, 0}, {12, 0, 9}};
  CellMap map = random_map(flat, 2);
  const Resized result = resized(flat, map, {2, 7, 0.5});
  EXPECT_TRUE((result.grid.positions.col(1).array() == 5).all());
  EXPECT_TRUE((result.scales.values.col(1).array() == 1).all());
  EXPECT_NEAR(result.grid.positions.col(0).maxCoeff(), 24, 1e-9);
  map.theta.col(1).setConstant(0.3);  // Nor does it matter how vulnerable cells are along it.
  EXPECT_EQ(result.grid.positions, resized(flat, map, {2, 1, 0.5}).grid.positions);

  const GridShape line = {{{6, 1, 1}}, {1, 2, 3}, {3, 0, 0}};
  const AxisValues placed = resized(line, random_map(line, 2), {4, 1, 1}).grid.positions;
  EXPECT_NEAR(placed.col(0).maxCoeff(), 13, 1e-9);
  const GridShape point = {{{1, 1, 1}}, {1, 2, 3}, {0, 0, 0}};
  EXPECT_EQ(resized(point, protected_map(point), {4, 1, 1}).grid.positions, rest_vertices(point));
}

TEST(ResizeGrid, IsTheSameFromAnyNumberOfThreadsAndAgain) {
  const GridShape shape = unit_cells(50, 46, 48);
  const CellMap map = car_map(shape);
  const Factors factors(0.5, 1, 1.5);
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const Resized one = resized(shape, map, factors, 1e-3);
  omp_set_num_threads(3);
  const ScaleSolve solve(shape, map);
  const Assembly assembly(shape, map);
  solve.solve({1, 3, 1}, {0, 1e-2});
  const Scales scales = solve.solve(factors, {0, 1e-3});
  const GridVertices vertices = assembly.place(scales.values, factors, {1e-3});
  omp_set_num_threads(threads);
  EXPECT_EQ(one.scales.values, scales.values);
  EXPECT_EQ(one.grid.positions, vertices.positions);
}

TEST(ResizeGrid, EndsWhereItIsCancelled) {
  const GridShape shape = unit_cells(12, 9, 10);
  const CellMap map = random_map(shape, 1);
  int left = 3;
  const Poll poll = [&] {
    if (--left == 0) throw Cancelled();
  };
  const ScaleSolve solve(shape, map);
  EXPECT_THROW(solve.solve({2, 1, 1}, {}, poll), Cancelled);
  const Scales scales = solve.solve({2, 1, 1});  // What was cancelled leaves no trace.
  EXPECT_EQ(scales.values, ScaleSolve(shape, map).solve({2, 1, 1}).values);
  left = 3;
  EXPECT_THROW(Assembly(shape, map).place(scales.values, {2, 1, 1}, {}, poll), Cancelled);
}

TEST(ResizeGrid, RefusesWhatItCannotTake) {
  const GridShape shape = unit_cells(3, 4, 5);
  const CellMap good = free_map(shape);
  const auto refused = [&](const std::string& with, const std::function<void(GridShape&, CellMap&)>& spoil) {
    GridShape bad_shape = shape;
    CellMap bad = good;
    spoil(bad_shape, bad);
    expect_refused([&] { ScaleSolve solve(bad_shape, bad); }, with);
    expect_refused([&] { Assembly assembly(bad_shape, bad); }, with);
  };
  refused("map.theta: nan in cell 7 along y is not in [0, 1]", [](GridShape&, CellMap& map) { map.theta(7, 1) = NAN; });
  refused("map.theta: 1.001 in cell 0 along z is not in [0, 1]",
          [](GridShape&, CellMap& map) { map.theta(0, 2) = 1.001; });
  refused("map.phi: 0 in cell 59 is not in [0.001, 1000]", [](GridShape&, CellMap& map) { map.phi[59] = 0; });
  refused("map.phi: 59 rows, but there are 60 cells", [](GridShape&, CellMap& map) { map.phi.resize(59); });
  refused("map.theta: 61 rows, but there are 60 cells", [](GridShape&, CellMap& map) { map.theta.resize(61, 3); });
  refused("shape: 0 cells along y, below 1", [](GridShape& grid, CellMap&) { grid.cells[1] = 0; });
  refused("size below 0 along z", [](GridShape& grid, CellMap&) { grid.size[2] = -1; });
  refused("shape: more than one cell along x, where it has no extent",
          [](GridShape& grid, CellMap&) { grid.size[0] = 0; });
  refused("more than 100 million cells", [](GridShape& grid, CellMap&) { grid.cells = {{60000, 60000, 60000}}; });

  const ScaleSolve solve(shape, good);
  const Assembly assembly(shape, good);
  const AxisValues ones = AxisValues::Ones(60, 3);
  for (const double bad : {0.0, -1.0, double{INFINITY}, double{NAN}}) {
    expect_refused([&] { solve.solve({1, bad, 1}); }, " along y is not in [1e-6, 1e6]");
    expect_refused([&] { assembly.place(ones, {1, 1, bad}); }, " along z is not in [1e-6, 1e6]");
  }
  expect_refused([&] { solve.solve({1, 1, 1}, {-1, 1e-6}); }, "options.size_weight");
  expect_refused([&] { solve.solve({1, 1, 1}, {0, 0}); }, "options.tolerance");
  expect_refused([&] { assembly.place(ones, {1, 1, 1}, {1}); }, "options.tolerance");
  expect_refused([&] { assembly.place(ones.topRows(59), {1, 1, 1}); }, "scales: 59 rows, but there are 60 cells");
  expect_refused([&] { assembly.place(NAN * ones, {1, 1, 1}); }, "scales: row 0 is not finite");
  expect_refused([&] { carry(shape, ones, ones); }, "carry: vertices");
  expect_refused([&] { carry(shape, rest_vertices(shape), NAN * ones); }, "carry: points: row 0 is not finite");
}

}  // namespace
}  // namespace swage::test
