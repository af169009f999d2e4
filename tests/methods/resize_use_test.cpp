// Resizing as callers use it: plans, maps, anchors, progress, refusals.
#include "swage/resize.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "ball_amid_slabs.h"
#include "shapes.h"
#include "swage/error.h"

namespace swage::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using Factors = Eigen::RowVector3d;

TEST(ResizeUse, LeavesInPlaceWhatItIsAnchoredBy) {
  const Mesh mesh = ball_amid_slabs();
  ResizeTarget target = by(2, 0.5, 3);
  target.anchors = {ResizeAnchor::high, ResizeAnchor::center, ResizeAnchor::low};
  const Positions result = resize(mesh.positions, mesh.triangles, target, coarse()).positions;
  const auto low = [](const Positions& of, int u) { return of.col(u).minCoeff(); };
  const auto high = [](const Positions& of, int u) { return of.col(u).maxCoeff(); };
  EXPECT_NEAR(high(result, 0), high(mesh.positions, 0), 1e-9);
  EXPECT_NEAR(low(result, 1) + high(result, 1), low(mesh.positions, 1) + high(mesh.positions, 1), 1e-9);
  EXPECT_NEAR(low(result, 2), low(mesh.positions, 2), 1e-9);
}

TEST(ResizeUse, SolvesAgainWithoutAnalysingAgain) {
  const Mesh mesh = ball_amid_slabs();
  Resize plan(mesh.positions, mesh.triangles, coarse());
  ASSERT_TRUE(plan.prepare());
  std::vector<std::string> stages;
  const auto note = [&](const Progress& p) {
    if (stages.empty() || stages.back() != p.stage) stages.emplace_back(p.stage);
    return true;
  };
  for (const double factor : {2.0, 0.5, 2.0}) {
    const ResizeResult result = plan.solve(by(factor, 1, 1), note);
    const Positions alone = resize(mesh.positions, mesh.triangles, by(factor, 1, 1), coarse()).positions;
    EXPECT_EQ(result.positions, alone);
  }
  EXPECT_THAT(stages, testing::Not(Contains("vulnerability")));
  EXPECT_THAT(stages, Contains("assembly"));
}

TEST(ResizeUse, ThreadsMaySolveAtOnce) {
  const Mesh mesh = ball_amid_slabs();
  Resize plan(mesh.positions, mesh.triangles, coarse());
  std::array<Positions, 4> results;
  std::vector<std::thread> threads;
  for (size_t i = 0; i < results.size(); ++i) {
    threads.emplace_back([&, i] { results[i] = plan.solve(by(1 + 0.5 * static_cast<double>(i % 2), 1, 1)).positions; });
  }
  for (std::thread& thread : threads) thread.join();
  for (size_t i = 0; i < results.size(); ++i) EXPECT_EQ(results[i], results[i % 2]);
}

TEST(ResizeUse, ProgressNeverFallsAndCancelsAnywhere) {
  const Mesh mesh = ball_amid_slabs();
  int calls = 0;
  double last = 0;
  Resize whole(mesh.positions, mesh.triangles, coarse());
  const Positions expected = whole
                                 .solve(by(2, 1, 1),
                                        [&](const Progress& p) {
                                          EXPECT_GE(p.fraction, last);
                                          EXPECT_LE(p.fraction, 1);
                                          last = p.fraction;
                                          ++calls;
                                          return true;
                                        })
                                 .positions;
  ASSERT_GE(calls, 5);
  for (int stop = 1; stop <= 5; ++stop) {
    Resize plan(mesh.positions, mesh.triangles, coarse());
    int left = stop;
    const ResizeResult result = plan.solve(by(2, 1, 1), [&](const Progress&) { return --left > 0; });
    EXPECT_EQ(result.report.stop, Termination::cancelled);
    EXPECT_EQ(result.positions, mesh.positions);
    EXPECT_EQ(plan.solve(by(2, 1, 1)).positions, expected);
  }
}

TEST(ResizeUse, TakesAnyMap) {
  const Mesh mesh = ball_amid_slabs();
  Resize plan(mesh.positions, mesh.triangles, coarse());
  CellMap map = plan.map();
  map.theta.setZero();
  plan.set_map(map);
  const Positions plain = plan.solve(by(2, 1, 1)).positions;
  Positions expected = mesh.positions;
  expected.col(0) *= 2;
  EXPECT_LT((plain - expected).cwiseAbs().maxCoeff(), 1e-6);
  map.theta(3, 1) = 2;
  EXPECT_THROW(plan.set_map(map), InvalidInput);
  map.theta.conservativeResize(4, 3);
  EXPECT_THROW(plan.set_map(map), InvalidInput);
}

TEST(ResizeUse, RefusesWhatItCannotDo) {
  const Mesh mesh = sphere();
  const auto refusal = [&](const auto& change) -> std::string {
    ResizeOptions options = coarse();
    ResizeTarget target = by(2, 1, 1);
    Protection protection;
    protection.triangles = {0};
    change(options, target, protection);
    try {
      Resize plan(mesh.positions, mesh.triangles, options);
      plan.protect(protection);
      plan.solve(target);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "";
  };
  using O = ResizeOptions;
  using T = ResizeTarget;
  using P = Protection;
  EXPECT_EQ(refusal([](O&, T&, P&) {}), "");
  EXPECT_THAT(refusal([](O& o, T&, P&) { o.cells = {-1, 0, 0}; }), HasSubstr("options.cells: -1"));
  EXPECT_THAT(refusal([](O& o, T&, P&) { o.cells = {900, 900, 900}; }), HasSubstr("10 million"));
  EXPECT_THAT(refusal([](O& o, T&, P&) { o.longest = 1; }), HasSubstr("options.longest"));
  EXPECT_THAT(refusal([](O& o, T&, P&) { o.tolerance = 0; }), HasSubstr("tolerance"));
  EXPECT_THAT(refusal([](O& o, T&, P&) { o.vulnerability.crease_angle = 4; }), HasSubstr("crease_angle"));
  EXPECT_THAT(refusal([](O& o, T&, P&) { o.vulnerability.slippage_limit = 0; }), HasSubstr("slippage_limit"));
  EXPECT_THAT(refusal([](O&, T& t, P&) { t.factors[1] = 0; }), HasSubstr("along y"));
  EXPECT_THAT(refusal([](O&, T& t, P&) { t.factors[0] = NAN; }), HasSubstr("along x"));
  EXPECT_THAT(refusal([](O&, T& t, P&) { t.factors[2] = 1e7; }), HasSubstr("along z"));
  EXPECT_THAT(refusal([](O&, T& t, P&) { t.size_weight = -1; }), HasSubstr("size_weight"));
  EXPECT_THAT(refusal([](O&, T&, P& p) { p.value = 1.5; }), HasSubstr("value"));
  EXPECT_THAT(refusal([](O&, T&, P& p) { p.triangles = {100000}; }), HasSubstr("100000 is none of"));
  EXPECT_THAT(refusal([](O&, T&, P& p) { p.triangles.clear(); }), HasSubstr("touch no cell"));
  EXPECT_THAT(refusal([](O&, T&, P& p) {
                p.triangles.clear();
                p.box = Eigen::AlignedBox3d(Eigen::Vector3d(5, 5, 5), Eigen::Vector3d(6, 6, 6));
              }),
              HasSubstr("touch no cell"));
  EXPECT_THAT(refusal([](O&, T&, P& p) { p.box = Eigen::AlignedBox3d(); }), HasSubstr("box"));
  const Mesh point{Positions::Constant(3, 3, 7), Triangles{{0, 1, 2}}};
  EXPECT_THROW(Resize(point.positions, point.triangles), InvalidInput);
}

TEST(ResizeUse, ChoosesCellsNearCubes) {
  const Mesh mesh = box({6, 3, 1}, 2);
  Resize chosen(mesh.positions, mesh.triangles);
  EXPECT_EQ(chosen.shape().cells.counts, (std::array<int, 3>{60, 30, 10}));
  ResizeOptions options;
  options.longest = 12;
  EXPECT_EQ(Resize(mesh.positions, mesh.triangles, options).shape().cells.counts, (std::array<int, 3>{12, 6, 5}));
  options.cells = {0, 15, 0};
  EXPECT_EQ(Resize(mesh.positions, mesh.triangles, options).shape().cells.counts, (std::array<int, 3>{30, 15, 5}));
  options.cells = {7, 8, 9};
  EXPECT_EQ(Resize(mesh.positions, mesh.triangles, options).shape().cells.counts, options.cells);
}

TEST(GridSurface, BoundsTheCellsThatFacesTouch) {
  const Mesh mesh = box({2, 1, 1}, 2);
  Resize plan(mesh.positions, mesh.triangles, coarse());
  std::vector<int> cells;
  const Mesh surface = grid_surface(plan.shape(), plan.map(), rest_vertices(plan.shape()), &cells);
  ASSERT_EQ(static_cast<Eigen::Index>(cells.size()), surface.triangles.rows());
  // Faces touch the outermost cells of the box: the hollow within is 18 x 8 x 8 of 20 x 10 x 10 cells.
  const double cell = 0.1 * 0.1 * 0.1;
  EXPECT_NEAR(volume(surface), 2 - 18 * 8 * 8 * cell, 1e-9);
  EXPECT_THROW(grid_surface(plan.shape(), plan.map(), surface.positions.topRows(2)), InvalidInput);
}

}  // namespace
}  // namespace swage::test
