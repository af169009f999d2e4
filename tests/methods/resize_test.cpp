// What resizing keeps, and what it changes.
#include "swage/resize.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "ball_amid_slabs.h"
#include "energy.h"
#include "shapes.h"
#include "swage/error.h"

namespace swage::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using Factors = Eigen::RowVector3d;

TEST(Resize, MeetsTheBoxAndKeepsItsLowCorner) {
  const Mesh mesh = transformed(ball_amid_slabs(), 1, {10, -20, 30});
  for (const Factors& factors : {Factors(2, 1, 1), Factors(1, 0.5, 1), Factors(0.3, 1, 3), Factors(0.05, 20, 1)}) {
    ResizeTarget target;
    target.factors = factors;
    const ResizeResult result = resize(mesh.positions, mesh.triangles, target, coarse());
    const double D = box_diagonal(result.positions);
    EXPECT_LT((extents(result.positions) - factors.cwiseProduct(extents(mesh.positions))).norm(), 1e-9 * D);
    EXPECT_LT((result.positions.colwise().minCoeff() - mesh.positions.colwise().minCoeff()).norm(), 1e-9 * D);
    EXPECT_EQ(result.report.stop, Termination::energy_settled);
  }
}

TEST(Resize, IsTheSameAtAnySizeAndPlace) {
  const Mesh mesh = ball_amid_slabs();
  const Positions expected = resize(mesh.positions, mesh.triangles, by(2, 1, 0.5), coarse()).positions;
  for (const double scale : {1e-6, 1e6}) {
    for (const double off : {0.0, 1e3}) {
      const Mesh moved = transformed(mesh, scale, Eigen::Vector3d::Constant(off * scale));
      Positions result = resize(moved.positions, moved.triangles, by(2, 1, 0.5), coarse()).positions;
      result = (result.array() - off * scale) / scale;
      EXPECT_LT((result - expected).cwiseAbs().maxCoeff(), 1e-6 * box_diagonal(mesh.positions)) << scale << " " << off;
    }
  }
}

/// By how much the ball's extents differ.
double aspect_error(const Positions& positions) {
  const Eigen::RowVector3d size = extents(ball_of(positions));
  return size.maxCoeff() / size.minCoeff() - 1;
}

TEST(Resize, KeepsABallAmidSlabsRound) {
  const Mesh mesh = ball_amid_slabs();
  Resize plan(mesh.positions, mesh.triangles);
  EXPECT_LT(aspect_error(plan.solve(by(2, 1, 1)).positions), 0.05);
  // It reaches nearly from side to side: there is no room beside it, and little can be done.
  EXPECT_LT(aspect_error(plan.solve(by(1, 1, 1.5)).positions), 0.45);
}

TEST(Resize, ReleasesWhatTheUserReleases) {
  const Mesh mesh = ball_amid_slabs();
  Protection release;
  release.triangles = ball_triangles();
  release.value = 0;
  Resize plan(mesh.positions, mesh.triangles, coarse());
  EXPECT_LT(aspect_error(plan.solve(by(2, 1, 1)).positions), 0.1);
  plan.protect(release);
  EXPECT_NEAR(aspect_error(plan.solve(by(2, 1, 1)).positions), 1, 0.1);
  plan.reset_map();
  EXPECT_LT(aspect_error(plan.solve(by(2, 1, 1)).positions), 0.1);
}

TEST(Resize, ProtectsWhatTheUserProtects) {
  const Mesh mesh = ball_amid_slabs();
  Protection slab;
  slab.box = Eigen::AlignedBox3d(Eigen::Vector3d(-1, -1, -1), Eigen::Vector3d(1, 3, 3));
  slab.axes = {true, false, false};
  Resize plan(mesh.positions, mesh.triangles, coarse());
  const auto thickness = [](const ResizeResult& result) { return extents(slab_of(result.positions))[0]; };
  const double loose = thickness(plan.solve(by(2, 1, 1, ResizeKeep::size)));
  plan.protect(slab);
  EXPECT_GT(loose, 1.5);
  EXPECT_NEAR(thickness(plan.solve(by(2, 1, 1, ResizeKeep::size))), 1, 0.05);
  EXPECT_EQ(plan.map().theta.col(1).topRows(1)(0), Resize(mesh.positions, mesh.triangles, coarse()).map().theta(0, 1));
  slab.value = 0;
  plan.protect(slab);  // The last counts.
  EXPECT_GT(thickness(plan.solve(by(2, 1, 1, ResizeKeep::size))), 1.5);
}

TEST(Resize, TellsWhereSizeCannotBeKept) {
  const Mesh mesh = ball_amid_slabs();
  Resize plan(mesh.positions, mesh.triangles, coarse());
  EXPECT_THAT(plan.solve(by(2, 1, 1, ResizeKeep::size)).report.warnings, testing::IsEmpty());
  Protection most;
  most.box = Eigen::AlignedBox3d(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(4.8, 2, 2));
  plan.protect(most);
  EXPECT_THAT(plan.solve(by(0.9, 1, 1)).report.warnings, testing::IsEmpty());
  EXPECT_THAT(plan.solve(by(0.5, 1, 1)).report.warnings, Contains(HasSubstr("larger than the new size")));
  const ResizeResult shrunk = plan.solve(by(0.5, 1, 1, ResizeKeep::size));
  EXPECT_THAT(shrunk.report.warnings, Contains(HasSubstr("0.8 of the box, and 0.5 is asked for")));
  EXPECT_GT(shrunk.least_scale, 0);
  most.box->max()[0] = 6;
  plan.protect(most);
  EXPECT_THAT(plan.solve(by(2, 1, 1, ResizeKeep::size)).report.warnings, Contains(HasSubstr("from end to end")));
}

TEST(Resize, FactorsAlongAxesOfNoExtentChangeNothing) {
  const Mesh mesh = sheet();
  const ResizeResult result = resize(mesh.positions, mesh.triangles, by(2, 1, 5), coarse());
  EXPECT_EQ(result.positions.col(2), mesh.positions.col(2));
  EXPECT_NEAR(extents(result.positions)[0], 2, 1e-12);
  EXPECT_EQ(result.factors, Factors(2, 1, 1));
  EXPECT_THAT(result.report.warnings, Contains(HasSubstr("no extent along z")));
  // A line of vertices has an extent along one axis only.
  Mesh line{Positions::Zero(3, 3), Triangles{{0, 1, 2}}};
  line.positions.col(1) << 0, 1, 3;
  EXPECT_NEAR(extents(resize(line.positions, line.triangles, by(1, 0.5, 1), coarse()).positions)[1], 1.5, 1e-12);
}

TEST(Resize, TakesAnyTriangles) {
  Mesh mesh = joined(awkward(), transformed(sphere(0.5, 2), 1, {3, 0, 0}));
  const Eigen::Index count = mesh.positions.rows();
  mesh.positions.conservativeResize(count + 1, 3);
  mesh.positions.row(count) << 5, 1, 1;  // Of no triangle, and the farthest.
  const ResizeResult result = resize(mesh.positions, mesh.triangles, by(2, 1, 3), coarse());
  ASSERT_EQ(result.positions.rows(), mesh.positions.rows());
  EXPECT_TRUE(result.positions.allFinite());
  EXPECT_LT((extents(result.positions) - Factors(2, 1, 3).cwiseProduct(extents(mesh.positions))).norm(), 1e-9);
  // Vertices at one place still are.
  for (Eigen::Index v = 0; v < count; ++v) {
    for (Eigen::Index w = 0; w < v; ++w) {
      if (mesh.positions.row(v) != mesh.positions.row(w)) continue;
      EXPECT_EQ(result.positions.row(v), result.positions.row(w));
    }
  }
}

TEST(Resize, LosesNothingFarFromTheOrigin) {
  const Mesh mesh = transformed(ball_amid_slabs(), 1, {1e9, -1e9, 1e9});
  const ResizeResult result = resize(mesh.positions, mesh.triangles, by(2, 1, 1), coarse());
  EXPECT_LT((extents(result.positions) - Factors(2, 1, 1).cwiseProduct(extents(mesh.positions))).norm(), 1e-6);
}

double sum_of(const std::map<std::string, double>& terms, const std::vector<std::string>& names) {
  double sum = 0;
  for (const std::string& name : names) sum += terms.at(name);
  return sum;
}

/// Moves a cell's scale, or a vertex, and another's of the same row the other way.
void disturb(AxisValues& values, Eigen::Index at, Eigen::Index other, int axis, double by) {
  values(at, axis) += by;
  if (other >= 0) values(other, axis) -= by;
}

/// The energies told are those minimised: whatever keeps the box has more.
TEST(Resize, ScalesAndVerticesHaveTheLeastEnergy) {
  const Mesh mesh = ball_amid_slabs();
  ResizeOptions options = coarse();
  options.tolerance = 1e-9;
  Resize plan(mesh.positions, mesh.triangles, options);
  const GridShape& shape = plan.shape();
  for (const ResizeKeep keep : {ResizeKeep::shape, ResizeKeep::size}) {
    const ResizeTarget target = by(1.3, 1, 1, keep);
    const ResizeResult result = plan.solve(target);
    ASSERT_EQ(result.scales_at_bound + result.edges_at_bound, 0);
    std::vector<std::string> of_scales = {"modulation", "compatibility"};
    if (keep == ResizeKeep::size) of_scales.emplace_back("size");
    const auto terms = [&](const AxisValues& scales, const AxisValues& grid) {
      return energy_by_term(shape, plan.map(), target, scales, grid);
    };
    const auto best = terms(result.scales, result.grid);
    EXPECT_EQ(best, result.report.energy_by_term);
    std::mt19937 random(3);
    const auto any = [&](int below) { return std::uniform_int_distribution<int>(0, below - 1)(random); };
    for (int i = 0; i < 200; ++i) {
      const int u = any(3), j = any(shape.cells[1]), k = any(shape.cells[2]);
      const Eigen::Index x = shape.cells.at(any(shape.cells[0]), j, k);
      AxisValues scales = result.scales;
      const int place = static_cast<int>(x / shape.cells.stride(u) % shape.cells[u]);
      const Eigen::Index y = x + (any(shape.cells[u]) - place) * shape.cells.stride(u);
      if (x == y) continue;
      disturb(scales, x, y, u, i % 2 == 0 ? 1e-3 : -1e-3);
      EXPECT_GT(sum_of(terms(scales, result.grid), of_scales), sum_of(best, of_scales));
      AxisValues grid = result.grid;
      const Eigen::Index vertex =
          shape.vertices().at(1 + any(shape.cells[0] - 1), 1 + any(shape.cells[1] - 1), 1 + any(shape.cells[2] - 1));
      disturb(grid, vertex, -1, u, i % 2 == 0 ? 1e-3 : -1e-3);
      const std::vector<std::string> of_grid = {"scale", "orthogonality"};
      EXPECT_GT(sum_of(terms(result.scales, grid), of_grid), sum_of(best, of_grid));
    }
  }
}

}  // namespace
}  // namespace swage::test
