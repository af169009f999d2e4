// Reshaping one mesh again: several gestures at once, and gestures from the result of the last.
#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "measures.h"
#include "opencl_device.h"
#include "shapes.h"
#include "swage/error.h"
#include "swage/reshape.h"

namespace swage {
namespace {

std::vector<Gesture> gestures(const Mesh& mesh) {
  std::vector<Gesture> all;
  for (int g = 0; g < 8; ++g) all.push_back(test::move_top(mesh, {0.05 * g, 0.4 - 0.1 * g, 0.02 * g * g}));
  return all;
}

std::vector<ReshapeResult> at_once(Reshape& reshape, const std::vector<Gesture>& gestures, int thread_count) {
  std::vector<ReshapeResult> results(gestures.size());
  std::atomic<size_t> next = 0;
  std::vector<std::thread> threads;
  for (int t = 0; t < thread_count; ++t) {
    threads.emplace_back([&] {
      for (size_t g = next++; g < gestures.size(); g = next++) results[g] = reshape.solve(gestures[g]);
    });
  }
  for (std::thread& thread : threads) thread.join();
  return results;
}

void expect_the_same_at_once(const Mesh& mesh, const ReshapeOptions& options) {
  const std::vector<Gesture> all = gestures(mesh);
  Reshape one_by_one(mesh.positions, mesh.triangles, options), parallel(mesh.positions, mesh.triangles, options);
  std::vector<ReshapeResult> expected;
  for (const Gesture& gesture : all) expected.push_back(one_by_one.solve(gesture));
  for (int round = 0; round < 2; ++round) {
    const std::vector<ReshapeResult> results = at_once(parallel, all, 4);
    for (size_t g = 0; g < all.size(); ++g) {
      EXPECT_EQ(results[g].positions, expected[g].positions) << "gesture " << g << ", round " << round;
      EXPECT_EQ(results[g].transforms, expected[g].transforms) << "gesture " << g << ", round " << round;
      EXPECT_EQ(results[g].report.energies, expected[g].report.energies) << "gesture " << g << ", round " << round;
    }
  }
}

void expect_the_same_at_once(const std::shared_ptr<Backend>& backend) {
  ReshapeOptions options;
  options.backend = backend;
  for (const ReshapeSolver solver : {ReshapeSolver::steady, ReshapeSolver::published}) {
    SCOPED_TRACE(to_string(solver));
    options.solver = solver;
    expect_the_same_at_once(test::cylinder(0.5, 1, 24, 8), options);
  }
}

TEST(ReshapeAtOnce, GivesTheSameBytesAsOneAfterTheOther) { expect_the_same_at_once(cpu_backend()); }

TEST(ReshapeAtOnce, GivesTheSameBytesOnADevice) {
  for (const Precision precision : {Precision::twice, Precision::single}) {
    const auto backend = test::opencl_or_skip(precision);
    if (!backend) return;
    expect_the_same_at_once(backend);
  }
}

/// Factors of dense blocks, which such a mesh has, solved by several threads.
TEST(ReshapeAtOnce, GivesTheSameBytesOnALargerMesh) {
  const Mesh mesh = test::sphere(0.5, 4);
  ReshapeOptions options;
  options.pass_limit = 3;
  expect_the_same_at_once(mesh, options);
  options.refactor_every_pass = true;
  expect_the_same_at_once(mesh, options);
}

TEST(ReshapeAtOnce, TheFirstPreparesAndACancelledOneLeavesItToTheNext) {
  const Mesh mesh = test::cylinder(0.5, 1, 24, 8);
  const Gesture gesture = test::move_top(mesh, {0, 0.3, 0});
  const Positions expected = reshape(mesh.positions, mesh.triangles, gesture).positions;
  Reshape prepared(mesh.positions, mesh.triangles);
  std::vector<Positions> results(4);
  std::vector<std::thread> threads;
  threads.emplace_back([&] { prepared.prepare([](const Progress&) { return false; }); });
  for (Positions& result : results) threads.emplace_back([&] { result = prepared.solve(gesture).positions; });
  for (std::thread& thread : threads) thread.join();
  for (const Positions& result : results) EXPECT_EQ(result, expected);
}

TEST(ReshapeAtOnce, AFailedSolveLeavesNothingBehind) {
  const Mesh mesh = test::cylinder(0.5, 1, 24, 8);
  const Gesture gesture = test::move_top(mesh, {0, 0.3, 0});
  Reshape prepared(mesh.positions, mesh.triangles);
  const Positions expected = prepared.solve(gesture).positions;
  const auto fails = [](const Progress& progress) {
    return progress.pass < 3 ? true : throw std::runtime_error("the caller's");
  };
  EXPECT_THROW(prepared.solve(test::move_top(mesh, {0.3, 0, 0}), fails), std::runtime_error);
  EXPECT_EQ(prepared.solve(gesture).positions, expected);
}

struct Drag {
  ReshapeResult last;
  int passes = 0;
};

/// From rest to the gesture in ten steps, each from the last or each from rest.
Drag dragged(Reshape& reshape, const Mesh& mesh, const Eigen::Vector3d& by, bool warm) {
  Drag drag;
  for (int step = 1; step <= 10; ++step) {
    const Gesture gesture = test::move_top(mesh, by * step / 10);
    drag.last = warm && step > 1 ? reshape.solve(gesture, drag.last) : reshape.solve(gesture);
    drag.passes += drag.last.report.passes;
  }
  return drag;
}

/// In mean edge lengths.
double apart_after(const ReshapeResult& a, const ReshapeResult& b, const Mesh& mesh) {
  return (a.unfinished - b.unfinished).rowwise().norm().maxCoeff() / mean_edge_length(mesh.positions, mesh.triangles);
}

TEST(ReshapeFromAResult, ADragEndsWhereTheGestureDoesInFewerPasses) {
  for (const Mesh& mesh : {test::cylinder(0.5, 1, 24, 8), test::box({1, 2, 1}, 5), test::torus(1, 0.4, 24, 12)}) {
    Reshape prepared(mesh.positions, mesh.triangles);
    const Eigen::Vector3d by(0.1, 0.4, 0.05);
    const Drag warm = dragged(prepared, mesh, by, true), cold = dragged(prepared, mesh, by, false);
    EXPECT_EQ(warm.last.report.stop, Termination::moved_little);
    // One more pass would move each of them by less than 1e-3, and plain passes come nearer the fixed point by a tenth
    // or more of what is left (steady.md): each is within 1e-3 / 0.1 of it.
    EXPECT_LT(apart_after(warm.last, cold.last, mesh), 0.02);
    EXPECT_LT(warm.passes, cold.passes);
  }
}

TEST(ReshapeFromAResult, StaysWhereItIs) {
  const Mesh mesh = test::cylinder(0.5, 1, 24, 8);
  const Gesture gesture = test::move_top(mesh, {0.1, 0.4, 0});
  Reshape prepared(mesh.positions, mesh.triangles);
  const ReshapeResult result = prepared.solve(gesture), again = prepared.solve(gesture, result);
  EXPECT_EQ(again.report.passes, 2);  // The stop's tests need as many.
  EXPECT_LT(apart_after(result, again, mesh), 2e-3);
  EXPECT_EQ(prepared.solve(gesture, result).positions, again.positions) << "the same bytes";
  EXPECT_EQ(prepared.solve(gesture).positions, result.positions) << "nothing of it remains";
}

TEST(ReshapeFromAResult, TransformsMapRestEdgesToEditedOnes) {
  const Mesh mesh = test::cylinder(0.5, 1, 24, 8);
  const ReshapeResult still = reshape(mesh.positions, mesh.triangles, test::move_top(mesh, {0, 0, 0}));
  Transforms identities = Transforms::Zero(mesh.triangles.rows(), 9);
  for (const int diagonal : {0, 4, 8}) identities.col(diagonal).setOnes();
  ASSERT_EQ(still.transforms.rows(), mesh.triangles.rows());
  EXPECT_LT((still.transforms - identities).cwiseAbs().maxCoeff(), 1e-9);
  const ReshapeResult longer = reshape(mesh.positions, mesh.triangles, test::move_top(mesh, {0, 0.5, 0}));
  double misses = 0, lengths = 0;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> transform(longer.transforms.row(t).data());
    const int i = mesh.triangles(t, 0), j = mesh.triangles(t, 1);
    const Eigen::Vector3d rest = mesh.positions.row(j) - mesh.positions.row(i);
    const Eigen::Vector3d edited = longer.unfinished.row(j) - longer.unfinished.row(i);
    misses += (transform * rest - edited).norm();
    lengths += edited.norm();
  }
  EXPECT_LT(misses, 0.01 * lengths);
}

TEST(ReshapeFromAResult, ACancelledSolveStaysAtTheStart) {
  const Mesh mesh = test::cylinder(0.5, 1, 24, 8);
  Reshape prepared(mesh.positions, mesh.triangles), unprepared(mesh.positions, mesh.triangles);
  const ReshapeResult start = prepared.solve(test::move_top(mesh, {0.1, 0.4, 0}));
  for (Reshape* const reshape : {&prepared, &unprepared}) {
    const ReshapeResult cancelled =
        reshape->solve(test::move_top(mesh, {0.2, 0.4, 0}), start, [](const Progress&) { return false; });
    EXPECT_EQ(cancelled.report.stop, Termination::cancelled);
    EXPECT_LT(apart_after(cancelled, start, mesh), 1e-12);
    EXPECT_EQ(cancelled.transforms, start.transforms);
  }
}

std::string refusal_of_start(Reshape& reshape, const Gesture& gesture, const ReshapeResult& start) {
  try {
    reshape.solve(gesture, start);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ReshapeFromAResult, RefusesOneOfAnotherMeshOrSolver) {
  const Mesh mesh = test::box({1, 1, 1}, 3);
  const Gesture gesture = test::move_top(mesh, {0, 0.2, 0});
  Reshape prepared(mesh.positions, mesh.triangles);
  const ReshapeResult good = prepared.solve(gesture);
  EXPECT_EQ(refusal_of_start(prepared, gesture, good), "accepted");
  EXPECT_THROW(prepared.solve({}, good), InvalidInput);

  ReshapeResult start = good;
  start.unfinished.conservativeResize(5, 3);
  EXPECT_NE(refusal_of_start(prepared, gesture, start).find("start.unfinished: 5 rows, but the mesh has 56 vertices"),
            std::string::npos)
      << refusal_of_start(prepared, gesture, start);
  start = good;
  start.transforms.resize(0, 9);
  EXPECT_NE(refusal_of_start(prepared, gesture, start).find("start.transforms: 0 rows"), std::string::npos);
  start = good;
  start.unfinished(3, 1) = std::numeric_limits<double>::infinity();
  EXPECT_NE(refusal_of_start(prepared, gesture, start).find("start.unfinished: row 3 is not finite"),
            std::string::npos);
  start = good;
  start.transforms(3, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal_of_start(prepared, gesture, start).find("start.transforms: row 3 is not finite"),
            std::string::npos);

  ReshapeOptions options;
  options.solver = ReshapeSolver::published;
  Reshape published(mesh.positions, mesh.triangles, options);
  EXPECT_NE(refusal_of_start(published, gesture, good).find("published"), std::string::npos);
}

}  // namespace
}  // namespace swage
