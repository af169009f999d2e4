// The carry step: slippage, cells and carried vertices, by every backend.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "adjacency.h"
#include "carried.h"
#include "clipped.h"
#include "measures.h"
#include "opencl_device.h"
#include "shapes.h"
#include "swage/error.h"

namespace swage {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::RowVector3d;
using test::touched_cells;

struct Who {
  const char* name;
  std::shared_ptr<Backend> (*backend)();
};

const Who kWho[] = {{"cpu", [] { return cpu_backend(); }},
                    {"opencl_single", [] { return test::opencl_or_skip(Precision::single); }},
                    {"opencl_double", [] { return test::opencl_or_skip(Precision::twice); }}};

class CarryStepBy : public testing::TestWithParam<Who> {
 protected:
  void SetUp() override { backend_ = GetParam().backend(); }

  std::unique_ptr<CarryStep> step(const Mesh& mesh) const { return backend_->carry(test::carried_rest(mesh)); }

  AxisValues slippage(const Mesh& mesh) const {
    AxisValues means;
    step(mesh)->slippage({0, mesh.triangles.rows()}, means);
    return means;
  }

  double rounding(double of_doubles) const { return test::sees_rounded(*backend_) ? 1e-6 : of_doubles; }

  std::shared_ptr<Backend> backend_;
};

/// The definition, by edges.
AxisValues expected_slippage(const Mesh& mesh) {
  const Edges edges = edges_of(mesh.triangles);
  const Positions normals = unit_normals(mesh.positions, mesh.triangles);
  AxisValues means(normals.rows(), 3);
  for (int t = 0; t < normals.rows(); ++t) {
    RowVector3d sum = RowVector3d::Zero();
    double weights = 0;
    for (const int e : edges.triangle_edges.row(t)) {
      const double length = edge_vectors(mesh.positions, edges).row(e).norm();
      for (const int other : edges.triangles[e]) {
        const Eigen::RowVector2i edge = edges.vertices.row(e);
        const bool alike = runs_along(mesh.triangles, t, edge) != runs_along(mesh.triangles, other, edge);
        const double cosine = normals.row(t).dot(normals.row(other)) * (other == t || alike ? 1 : -1);
        sum += length * std::max(0.0, cosine) * normals.row(other).cwiseAbs();
        weights += length * std::max(0.0, cosine);
      }
    }
    means.row(t) = sum / weights;
  }
  return means;
}

/// Sheets that share an edge, of which some wind against each other, a needle, and what has no area.
std::vector<std::pair<const char*, Mesh>> surfaces() {
  Mesh waves = test::sheet(12);
  for (auto p : waves.positions.rowwise()) p[2] = 0.2 * std::sin(7 * p[0] + 3 * p[1]);
  Mesh book = {Positions(7, 3), Triangles(5, 3)};
  book.positions << 0, 0, 0, 1, 0, 0, 0.3, 1, 0, 0.4, -1, 0.2, 0.5, 0.8, 0.9, 0.6, 0.9, 0.3, 0.1, 0.1, 1;
  book.triangles << 0, 1, 2, 1, 0, 3, 0, 1, 4, 1, 0, 5, 0, 1, 6;
  Mesh ball = test::sphere(1, 2);
  for (int t = 0; t < ball.triangles.rows(); t += 3) std::swap(ball.triangles(t, 0), ball.triangles(t, 1));
  return {{"torus", test::torus(1, 0.4, 24, 12)},
          {"box", test::box({1, 2, 3}, 3)},
          {"cylinder", test::cylinder(0.5, 2, 12, 3)},
          {"waves", waves},
          {"book", book},
          {"winding at random", ball}};
}

TEST_P(CarryStepBy, SlippageIsTheWeightedMean) {
  if (!backend_) return;
  for (const auto& [name, mesh] : surfaces()) {
    SCOPED_TRACE(name);
    EXPECT_LT((slippage(mesh) - expected_slippage(mesh)).cwiseAbs().maxCoeff(), rounding(1e-12));
  }
}

TEST_P(CarryStepBy, SlippageOfFlatAndRoundSidesIsTheirs) {
  if (!backend_) return;
  const Mesh box = test::box({1, 2, 3}, 3);
  const Positions normals = unit_normals(box.positions, box.triangles);
  EXPECT_LT((slippage(box) - normals.cwiseAbs()).cwiseAbs().maxCoeff(), rounding(1e-15)) << "corners count for nothing";
  const AxisValues along = slippage(test::cylinder(0.5, 2, 32, 4));
  for (Index t = 0; t < along.rows(); ++t) {
    EXPECT_TRUE(along(t, 1) < rounding(1e-15) || along(t, 1) > 1 - rounding(1e-15))
        << "sides slip along the axis, caps do not";
  }
}

TEST_P(CarryStepBy, SlippageLeavesOutWhatHasNoHeight) {
  if (!backend_) return;
  for (const double height : {0.0, 1e-12, 0.9e-5}) {
    // Two halves of a square and, between them, a needle that faces along x.
    Mesh mesh{Positions(5, 3), Triangles(3, 3)};
    mesh.positions << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 0.5, height;
    mesh.triangles << 0, 1, 2, 0, 2, 3, 0, 4, 2;
    const AxisValues means = slippage(mesh);
    EXPECT_LT((means.topRows<2>().rowwise() - RowVector3d(0, 0, 1)).norm(), 1e-12);
    EXPECT_TRUE(means.row(2).isZero(0)) << height;
  }
  Mesh upright{Positions(3, 3), Triangles(1, 3)};
  upright.positions << 0, 0, 0, 1, 0, 0, 0.5, 0, 1.1e-5;
  upright.triangles << 0, 1, 2;
  EXPECT_LT((slippage(upright).row(0) - RowVector3d(0, 1, 0)).norm(), 1e-9);
}

TEST_P(CarryStepBy, SlippageOfTinyTrianglesIsThatOfLargeOnes) {
  if (!backend_) return;
  const Mesh mesh = test::torus(1, 0.4, 24, 12);
  const AxisValues means = slippage(mesh);
  for (const double scale : {1e-9, 1e-3, 1e9}) {
    EXPECT_LT((slippage(test::transformed(mesh, scale, {0, 0, 0})) - means).cwiseAbs().maxCoeff(), 1e-6) << scale;
  }
}

TEST_P(CarryStepBy, AnEdgeOfManySidesEnds) {
  if (!backend_) return;
  // A fan of leaves around one edge: each sees as many of those after it as there may be, itself once a side.
  const int leaves = 200;
  Mesh fan{Positions(2 + leaves, 3), Triangles(leaves, 3)};
  fan.positions.topRows<2>() << 0, 0, 0, 0, 0, 1;
  for (int i = 0; i < leaves; ++i) {
    const double angle = 6.283 * i / leaves;
    fan.positions.row(2 + i) << std::cos(angle), std::sin(angle), 0.5;
    fan.triangles.row(i) << 0, 1, 2 + i;
  }
  const AxisValues means = slippage(fan);
  const Positions normals = unit_normals(fan.positions, fan.triangles);
  for (int i = 0; i < leaves; ++i) {
    const double own = 1 + 2 * std::hypot(1, 0.5);  // Its circumference.
    RowVector3d sum = own * normals.row(i).cwiseAbs();
    double weights = own;
    for (int k = 1; k <= CarryStep::kMostBeside; ++k) {
      const RowVector3d other = normals.row((i + k) % leaves);
      const double weight = std::max(0.0, -normals.row(i).dot(other));
      sum += weight * other.cwiseAbs();
      weights += weight;
    }
    EXPECT_LT((means.row(i) - sum / weights).norm(), rounding(1e-12)) << "leaf " << i;
  }
}

TEST_P(CarryStepBy, FindsTheCellsThatClippingFinds) {
  if (!backend_) return;
  for (const test::GridCase& of : test::grid_cases()) expect_touched(*step(of.mesh), of);
}

TEST_P(CarryStepBy, FacesThatOnlyGrazeCount) {
  if (!backend_) return;
  const GridShape shape = {{{4, 4, 4}}, {0, 0, 0}, {4, 4, 4}};
  Mesh mesh{Positions(3, 3), Triangles(1, 3)};
  mesh.triangles << 0, 1, 2;
  mesh.positions << 1, 1, 1, 2, 1, 1, 1, 2, 1;  // Half a face between two cells.
  EXPECT_EQ(touched_cells(*step(mesh), shape, {0, 1}).front().size(), 16)
      << "by their corners too, all around but for one";
  mesh.positions << 1.5, 1.5, 2, 1.7, 1.5, 2, 1.5, 1.7, 2;
  EXPECT_THAT(touched_cells(*step(mesh), shape, {0, 1}).front(),
              testing::ElementsAre(shape.cells.at(1, 1, 1), shape.cells.at(1, 1, 2)));
  mesh.positions << 0.5, 0.5, 0.5, 0.6, 0.5, 0.5, 1, 1, 1;
  EXPECT_EQ(touched_cells(*step(mesh), shape, {0, 1}).front().size(), 8) << "a corner in a corner";
  mesh.positions << 0.5, 0.5, 0.5, 0.6, 0.5, 0.5, 0.9999, 0.9999, 0.9999;
  EXPECT_EQ(touched_cells(*step(mesh), shape, {0, 1}).front().size(), 1);
}

TEST_P(CarryStepBy, AHugeTriangleAmongManyCellsIsQuick) {
  if (!backend_) return;
  // A plane touches some three cells a column; a search of all ten million cells would take minutes.
  const GridShape shape = {{{215, 215, 215}}, {0, 0, 0}, {1, 1, 1}};
  Mesh mesh{Positions(3, 3), Triangles(20, 3)};
  mesh.positions << 0, 0, 0.1, 1, 0, 0.9, 0, 1, 0.8;
  for (auto t : mesh.triangles.rowwise()) t << 0, 1, 2;
  for (const auto& cells : touched_cells(*step(mesh), shape, {0, 20})) {
    EXPECT_GT(cells.size(), 215 * 215 / 2);
    EXPECT_LT(cells.size(), 215 * 215 * 2);
  }
}

TEST_P(CarryStepBy, CarriesByTheTrilinearMap) {
  if (!backend_) return;
  const GridShape shape = {{{4, 3, 5}}, {-1, 2, 3}, {6, 5, 4}};
  const AxisValues rest = rest_vertices(shape), waves = rest + 0.1 * (3 * rest).array().sin().matrix();
  Mesh mesh{shape.corner.replicate(500, 1) +
                (Positions::Random(500, 3).array() * 0.5 + 0.5).matrix() * shape.size.asDiagonal(),
            Triangles(0, 3)};
  Positions carried;
  step(mesh)->carry(shape, waves, carried);
  for (Index v = 0; v < carried.rows(); ++v) {
    // By tent functions about all vertices of the grid.
    RowVector3d due = RowVector3d::Zero();
    for (Index g = 0; g < rest.rows(); ++g) {
      double weight = 1;
      for (int u = 0; u < 3; ++u) {
        const double width = shape.size[u] / shape.cells[u];
        weight *= std::max(0.0, 1 - std::abs(mesh.positions(v, u) - rest(g, u)) / width);
      }
      due += weight * waves.row(g);
    }
    EXPECT_LT((carried.row(v) - due).norm(), rounding(1e-12)) << "vertex " << v;
  }
}

TEST_P(CarryStepBy, CarriesOutsideAndBesideFlatGrids) {
  if (!backend_) return;
  const GridShape shape = {{{4, 3, 5}}, {-1, 2, 3}, {6, 5, 4}}, flat = {{{4, 1, 5}}, {-1, 2, 3}, {6, 0, 4}};
  const Mesh mesh{Positions::Random(200, 3) * 9, Triangles(0, 3)};
  Matrix3d linear;
  linear << 2, 0.1, 0, -0.3, 1, 0.2, 0, 0.4, 0.5;
  Positions carried;
  step(mesh)->carry(shape, rest_vertices(shape) * linear, carried);
  const double far = 1e3 * rounding(1e-15);  // Of sums of terms of some thousands.
  EXPECT_LT((carried - mesh.positions * linear).cwiseAbs().maxCoeff(), far);
  const RowVector3d factors(2, 1, 0.5);
  const AxisValues grid = rest_vertices(flat) * factors.asDiagonal();
  step(mesh)->carry(flat, grid, carried);
  EXPECT_LT((carried - mesh.positions * factors.asDiagonal()).cwiseAbs().maxCoeff(), far) << "at their distance";
}

TEST_P(CarryStepBy, GivesSlicesAndTheSameBytesAgain) {
  if (!backend_) return;
  const test::GridCase of = test::grid_cases().front();
  const Index count = of.mesh.triangles.rows();
  const auto own = step(of.mesh);
  const auto all = touched_cells(*own, of.shape, {0, count});
  for (const Slice& slice : {Slice{0, 7}, Slice{7, count}, Slice{5, 5}, Slice{count - 1, count}}) {
    const auto some = touched_cells(*own, of.shape, slice);
    EXPECT_TRUE(std::equal(some.begin(), some.end(), all.begin() + slice.first));
  }
  EXPECT_EQ(touched_cells(*step(of.mesh), of.shape, {0, count}), all);
  const Mesh ball = test::sphere(1, 2);
  const AxisValues means = slippage(ball);
  AxisValues some;
  const auto balls = step(ball);
  balls->slippage({10, 90}, some);
  EXPECT_EQ(some, means.middleRows(10, 80));
  balls->slippage({3, 3}, some);
  EXPECT_EQ(some.rows(), 0);
  EXPECT_EQ(slippage(ball), means);
}

TEST_P(CarryStepBy, RefusesOtherSizes) {
  if (!backend_) return;
  const Mesh mesh = test::sheet(2);
  const GridShape shape = {{{4, 3, 5}}, {-1, 2, 3}, {6, 5, 4}};
  const auto bare = backend_->carry({std::make_shared<Mesh>(mesh), {}});
  AxisValues values;
  Eigen::VectorXi cells;
  EXPECT_THROW(bare->slippage({0, 8}, values), InvalidInput);
  EXPECT_THROW(bare->list_cells(shape, {0, 8}, Eigen::VectorXi::Ones(7), cells), InvalidInput);
  EXPECT_THROW(bare->carry(shape, AxisValues::Zero(7, 3), values), InvalidInput);
}

INSTANTIATE_TEST_SUITE_P(Backends, CarryStepBy, testing::ValuesIn(kWho),
                         [](const auto& of) { return std::string(of.param.name); });

}  // namespace
}  // namespace swage
