// What large meshes take: multigrid in place of factors, coarse starts, and cancelling within a pass.
#include <gtest/gtest.h>

#ifdef _OPENMP
#include <omp.h>
#endif

#include <string>
#include <utility>

#include "measures.h"
#include "opencl_device.h"
#include "plan.h"
#include "shapes.h"
#include "swage/error.h"
#include "swage/reshape.h"

namespace swage {
namespace {

/// The farthest a vertex is from its place in the other, in mean edge lengths.
double difference(const Mesh& mesh, const ReshapeResult& a, const ReshapeResult& b) {
  return (a.positions - b.positions).rowwise().norm().maxCoeff() / mean_edge_length(mesh.positions, mesh.triangles);
}

ReshapeOptions solved_by(LinearSolver solver) {
  ReshapeOptions options;
  options.linear_solver = solver;
  return options;
}

ReshapeResult reshaped_large(const Mesh& mesh, const ReshapeOptions& options) {
  return reshape(mesh.positions, mesh.triangles, test::move_top(mesh, {0.1, 0.5, 0}), options);
}

TEST(LinearSolver, MultigridGoesToTheFactorsFixedPoint) {
  for (const Mesh& mesh : {test::cylinder(0.3, 1, 48, 40), test::sphere(0.5, 4), test::box({1, 2, 0.5}, 16)}) {
    const ReshapeResult factor = reshaped_large(mesh, solved_by(LinearSolver::factor));
    const ReshapeResult multigrid = reshaped_large(mesh, solved_by(LinearSolver::multigrid));
    EXPECT_EQ(factor.report.stop, Termination::moved_little);
    EXPECT_EQ(multigrid.report.stop, Termination::moved_little);
    EXPECT_LT(difference(mesh, multigrid, factor), 0.03);
    EXPECT_LE(multigrid.report.passes, 2 * factor.report.passes + 4);
  }
}

TEST(LinearSolver, MultigridOnADeviceIsThatOnTheCpu) {
  const auto backend = test::opencl_or_skip(Precision::twice);
  if (!backend) return;
  const Mesh mesh = test::cylinder(0.3, 1, 48, 40);
  ReshapeOptions options = solved_by(LinearSolver::multigrid);
  const ReshapeResult cpu = reshaped_large(mesh, options);
  options.backend = backend;
  EXPECT_LT(difference(mesh, reshaped_large(mesh, options), cpu), 1e-3);
}

TEST(LinearSolver, AutomaticGoesByTheFactorsMemoryAndSaysSo) {
  const Mesh mesh = test::cylinder(0.3, 1, 48, 40);
  ReshapeOptions options;
  options.factor_memory = 1'000'000;
  const Report little = reshaped_large(mesh, options).report;
  EXPECT_EQ(little.paths.at("transform_step").find("multigrid: a factor takes about 0.1 GB, over 0.0 GB"), 0U)
      << little.paths.at("transform_step");
  options.factor_memory = 1'000'000'000;
  const Report enough = reshaped_large(mesh, options).report;
  EXPECT_EQ(enough.paths.at("transform_step").find("factor: "), 0U) << enough.paths.at("transform_step");
  EXPECT_GT(enough.bytes.at("transform_system"), 2 * little.bytes.at("transform_system"));
}

// The estimate that decides, against the factor that is made: 12 bytes an entry while it is.
TEST(LinearSolver, AFactorTakesAboutWhatWasEstimated) {
  const Mesh mesh = test::cylinder(0.3, 1, 120, 84);
  ReshapeOptions options = solved_by(LinearSolver::factor);
  options.pass_limit = 1;
  const double bytes = static_cast<double>(reshaped_large(mesh, options).report.bytes.at("transform_system"));
  const double estimate = factor_bytes(mesh.triangles.rows()) / 3;  // Kept: single precision alone.
  EXPECT_GT(bytes, 0.6 * estimate);
  EXPECT_LT(bytes, 1.8 * estimate);
}

TEST(LinearSolver, AutomaticTriesMultigridAndLeavesNeedlesToAFactor) {
  ReshapeOptions options;
  options.pass_limit = 1;
  const auto path = [&](const Mesh& mesh) { return reshaped_large(mesh, options).report.paths.at("vertex_step"); };
  EXPECT_EQ(path(test::cylinder(0.3, 1, 60, 40)), "multigrid: 3182 vertices");
  EXPECT_EQ(path(test::cylinder(0.3, 1, 600, 2)), "factor: multigrid is slow on these triangles");
}

TEST(LinearSolver, StraightChainsHaveTheirVerticesFactored) {
  const Mesh mesh = test::box({1, 2, 0.5}, 16);
  ReshapeOptions options = solved_by(LinearSolver::multigrid);
  const Edges edges = edges_of(mesh.triangles);
  options.straight_chains = {{edges.vertices(0, 0), edges.vertices(0, 1)}};
  const Lists ring = one_rings(edges, static_cast<int>(mesh.positions.rows()));
  options.straight_chains[0].push_back(ring[edges.vertices(0, 1)][0] == edges.vertices(0, 0)
                                           ? ring[edges.vertices(0, 1)][1]
                                           : ring[edges.vertices(0, 1)][0]);
  const Report report = reshaped_large(mesh, options).report;
  EXPECT_EQ(report.paths.at("vertex_step").find("factor: straight chains"), 0U) << report.paths.at("vertex_step");
  EXPECT_EQ(report.paths.at("transform_step"), "multigrid: as asked");
}

TEST(LinearSolver, ThePublishedSolverHasNoMultigrid) {
  const Mesh mesh = test::box();
  ReshapeOptions options = solved_by(LinearSolver::multigrid);
  options.solver = ReshapeSolver::published;
  EXPECT_THROW(Reshape(mesh.positions, mesh.triangles, options), InvalidInput);
  options.solver = ReshapeSolver::steady;
  options.refactor_every_pass = true;
  EXPECT_THROW(Reshape(mesh.positions, mesh.triangles, options), InvalidInput);
}

Mesh large() { return test::cylinder(0.3, 1, 180, 120); }

TEST(CoarseStart, GoesToTheSameFixedPoint) {
  const Mesh mesh = large();
  ASSERT_GE(mesh.triangles.rows(), 40'000);
  ReshapeOptions options = solved_by(LinearSolver::multigrid);
  options.coarse_start = true;
  const ReshapeResult coarse = reshaped_large(mesh, options);
  EXPECT_EQ(coarse.report.paths.at("start").find("coarse: of "), 0U) << coarse.report.paths.at("start");
  EXPECT_GT(coarse.report.bytes.at("coarse_start"), 0U);
  options.coarse_start = false;
  const ReshapeResult fine = reshaped_large(mesh, options);
  EXPECT_EQ(fine.report.paths.at("start"), "rest: no coarse start asked for");
  EXPECT_LT(difference(mesh, coarse, fine), 0.05);
  EXPECT_EQ(coarse.report.stop, Termination::moved_little);
  EXPECT_LE(coarse.report.passes, 2 * fine.report.passes);  // More on a smooth shape such as this.
}

TEST(CoarseStart, IsCancelled) {
  const Mesh mesh = large();
  ReshapeOptions options = solved_by(LinearSolver::multigrid);
  options.coarse_start = true;
  Reshape prepared(mesh.positions, mesh.triangles, options);
  const ReshapeResult result = prepared.solve(test::move_top(mesh, {0, 0.5, 0}),
                                              [](const Progress& now) { return now.stage != std::string("coarse"); });
  EXPECT_EQ(result.report.stop, Termination::cancelled);
  EXPECT_EQ(result.positions, mesh.positions);
}

#ifdef _OPENMP
TEST(Cancel, WithinAPassGivesTheLastCompleteOne) {
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);  // So that passes take long enough to be asked within.
  const Mesh mesh = test::sphere(0.5, 6);
  ReshapeOptions options = solved_by(LinearSolver::multigrid);
  Reshape prepared(mesh.positions, mesh.triangles, options);
  const Gesture gesture = test::move_top(mesh, {0, 0.5, 0});
  int asked = 0;
  const ReshapeResult cancelled = prepared.solve(gesture, [&](const Progress& now) {
    asked = now.pass == 2 ? asked + 1 : 0;
    return asked < 2;
  });
  EXPECT_EQ(cancelled.report.stop, Termination::cancelled);
  EXPECT_EQ(cancelled.report.passes, 2);
  options.pass_limit = 2;
  options.finalise = false;
  EXPECT_EQ(cancelled.positions, reshape(mesh.positions, mesh.triangles, gesture, options).positions);
  omp_set_num_threads(threads);
}
#endif

TEST(Cancel, WithinFinishingGivesTheUnfinished) {
  const Mesh mesh = test::sphere(0.5, 3);
  Gesture gesture;
  gesture.add(0, mesh.positions.row(0));
  gesture.add(1, mesh.positions.row(1) * 1.5);
  Reshape prepared(mesh.positions, mesh.triangles);
  const ReshapeResult whole = prepared.solve(gesture);
  ASSERT_TRUE(whole.finalised);
  const ReshapeResult cancelled =
      prepared.solve(gesture, [](const Progress& now) { return now.stage != std::string("finish"); });
  EXPECT_EQ(cancelled.report.stop, Termination::cancelled);
  EXPECT_FALSE(cancelled.finalised);
  EXPECT_EQ(cancelled.positions, whole.unfinished);
  EXPECT_EQ(cancelled.report.passes, whole.report.passes);
  EXPECT_EQ(prepared.solve(gesture).positions, whole.positions);  // And nothing of it is left behind.
}

}  // namespace
}  // namespace swage
