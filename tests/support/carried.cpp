#include "carried.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "adjacency.h"
#include "clipped.h"

namespace swage::test {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::RowVector3d;

constexpr long double kSurely = 1e-12L;  // Cells: farther than rounding of a clipping goes.

Mesh loose(const std::vector<Matrix3d>& triangles) {
  const auto count = static_cast<Index>(triangles.size());
  Mesh mesh{Positions(3 * count, 3), Triangles(count, 3)};
  for (Index t = 0; t < count; ++t) {
    mesh.positions.middleRows<3>(3 * t) = triangles[static_cast<size_t>(t)];
    for (int k = 0; k < 3; ++k) mesh.triangles(t, k) = static_cast<int>(3 * t) + k;
  }
  return mesh;
}

class Source {
 public:
  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  RowVector3d point(double low, double high) { return {number(low, high), number(low, high), number(low, high)}; }
  Matrix3d triangle(double low, double high) {
    Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.row(k) = point(low, high);
    return corners;
  }

 private:
  std::mt19937 random_{5};
};

/// In units of the grid's size, from its corner.
Mesh placed_on_grid(const GridShape& shape, const std::vector<Matrix3d>& triangles) {
  Mesh mesh = loose(triangles);
  mesh.positions = (mesh.positions * shape.size.asDiagonal()).rowwise() + shape.corner;
  return mesh;
}

std::vector<Matrix3d> of_all_sizes(Source& source) {
  std::vector<Matrix3d> triangles;
  for (int i = 0; i < 60; ++i) {
    const double size = std::pow(10, source.number(-6, -0.3));
    const Matrix3d corners = size * source.triangle(-1, 1);
    triangles.emplace_back(corners.rowwise() + source.point(0.1, 0.9));
  }
  for (int i = 0; i < 20; ++i) triangles.push_back(source.triangle(0, 1));
  return triangles;
}

std::vector<Matrix3d> without_area(Source& source) {
  std::vector<Matrix3d> triangles;
  for (int i = 0; i < 20; ++i) {
    Matrix3d corners = source.triangle(0, 1);
    corners.row(2) = corners.row(0) + source.number(-0.5, 1.5) * (corners.row(1) - corners.row(0));  // A line,
    triangles.push_back(corners.cwiseMax(0).cwiseMin(1));
    corners.row(2) = corners.row(1);  // with a corner twice,
    triangles.push_back(corners);
    corners.rowwise() = corners.row(0).eval();  // and a point.
    triangles.push_back(corners);
  }
  return triangles;
}

/// Corners on the grid's own planes and midway between: most only graze some cells.
std::vector<Matrix3d> on_planes(Source& source, const GridShape& shape) {
  std::vector<Matrix3d> triangles;
  for (int i = 0; i < 60; ++i) {
    Matrix3d corners;
    for (int k = 0; k < 3; ++k) {
      for (int u = 0; u < 3; ++u) {
        corners(k, u) = std::floor(source.number(0, 2 * shape.cells[u] + 1)) / (2 * shape.cells[u]);
      }
    }
    if (i % 3 == 0) corners.col(i % 9 / 3).setConstant(std::floor(source.number(0, 5)) / 4);
    triangles.push_back(corners);
  }
  return triangles;
}

std::vector<Matrix3d> outside(Source& source) {
  std::vector<Matrix3d> triangles;
  for (int i = 0; i < 30; ++i) triangles.push_back(source.triangle(-3, 4));
  for (int i = 0; i < 10; ++i) triangles.emplace_back(source.triangle(0, 1).array() + 1.1);
  return triangles;
}

}  // namespace

CarryStep::Rest carried_rest(const Mesh& mesh) {
  const Edges edges = edges_of(mesh.triangles);
  CarryStep::Rest rest{std::make_shared<Mesh>(mesh), Triangles(mesh.triangles.rows(), 3)};
  std::vector<std::vector<int>> rings(static_cast<size_t>(edges.vertices.rows()));
  for (int side = 0; side < mesh.triangles.size(); ++side) {
    rings[static_cast<size_t>(edges.triangle_edges.data()[side])].push_back(side);
  }
  for (const std::vector<int>& ring : rings) {
    for (size_t i = 0; i < ring.size(); ++i) rest.next_sides.data()[ring[i]] = ring[(i + 1) % ring.size()];
  }
  return rest;
}

std::vector<GridCase> grid_cases() {
  Source source;
  const GridShape plain = {{{8, 6, 16}}, {0, 0, 0}, {8, 6, 16}}, odd = {{{13, 5, 9}}, {-7.3, 11.9, 0.4}, {2.6, 9, 0.7}};
  const GridShape flat = {{{12, 1, 9}}, {1, 2, 3}, {6, 0, 4}}, line = {{{1, 40, 1}}, {1, 2, 3}, {0, 5, 0}};
  const GridShape far = {{{7, 7, 7}}, {1e6, -1e6, 1e6}, {1, 2, 3}}, one = {{{1, 1, 1}}, {0, 0, 0}, {1, 1, 1}};
  std::vector<GridCase> cases;
  for (const GridShape& shape : {odd, flat, line, far, one}) {
    cases.push_back({"of all sizes", shape, placed_on_grid(shape, of_all_sizes(source))});
    cases.push_back({"without area", shape, placed_on_grid(shape, without_area(source))});
    cases.push_back({"outside", shape, placed_on_grid(shape, outside(source))});
  }
  for (const GridShape& shape : {plain, one}) {
    cases.push_back({"on planes", shape, placed_on_grid(shape, on_planes(source, shape))});
  }
  return cases;
}

std::vector<std::vector<int>> touched_cells(CarryStep& step, const GridShape& shape, Slice triangles) {
  Eigen::VectorXi counts, cells;
  step.count_cells(shape, triangles, counts);
  step.list_cells(shape, triangles, counts, cells);
  EXPECT_EQ(counts.size(), triangles.count());
  EXPECT_EQ(cells.size(), counts.sum());
  std::vector<std::vector<int>> lists;
  const int* next = cells.data();
  for (const int count : counts) {
    lists.emplace_back(next, next + count);
    next += count;
  }
  return lists;
}

void expect_touched(CarryStep& step, const GridCase& of) {
  SCOPED_TRACE(of.name + " on " + std::to_string(of.shape.cells[0]) + " x " + std::to_string(of.shape.cells[1]) +
               " x " + std::to_string(of.shape.cells[2]));
  const auto lists = touched_cells(step, of.shape, {0, of.mesh.triangles.rows()});
  for (Index t = 0; t < of.mesh.triangles.rows(); ++t) {
    Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.row(k) = of.mesh.positions.row(of.mesh.triangles(t, k));
    const std::vector<int>& cells = lists[static_cast<size_t>(t)];
    const std::vector<int> due = cells_by_clipping(of.shape, corners, kSurely);
    const std::vector<int> allowed = cells_by_clipping(of.shape, corners, step.cell_rounding(of.shape) + kSurely);
    ASSERT_TRUE(std::is_sorted(cells.begin(), cells.end())) << "triangle " << t;
    ASSERT_EQ(std::adjacent_find(cells.begin(), cells.end()), cells.end()) << "triangle " << t;
    ASSERT_TRUE(std::includes(cells.begin(), cells.end(), due.begin(), due.end()))
        << "triangle " << t << " touches " << due.size() << ", found " << cells.size();
    ASSERT_TRUE(std::includes(allowed.begin(), allowed.end(), cells.begin(), cells.end()))
        << "triangle " << t << " touches " << allowed.size() << " at most, found " << cells.size();
  }
}

}  // namespace swage::test
