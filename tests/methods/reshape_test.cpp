// What reshaping promises on any mesh.
#include "swage/reshape.h"

#include <gtest/gtest.h>
#ifdef _OPENMP
#include <omp.h>
#endif

#include <algorithm>
#include <numeric>
#include <random>

#include "edit_measures.h"
#include "measures.h"
#include "shapes.h"
#include "swage/error.h"

namespace swage {
namespace {

Mesh part() { return test::cylinder(0.5, 1, 24, 8); }

int vertex_nearest(const Mesh& mesh, const Eigen::RowVector3d& point) {
  Eigen::Index nearest = 0;
  (mesh.positions.rowwise() - point).rowwise().squaredNorm().minCoeff(&nearest);
  return static_cast<int>(nearest);
}

/// The middle of the bottom pinned, the middle of the top lifted by `lift`.
Gesture lift_top(const Mesh& mesh, const Eigen::Vector3d& lift) {
  const Eigen::RowVector3d low = mesh.positions.colwise().minCoeff(), high = mesh.positions.colwise().maxCoeff();
  const Eigen::RowVector3d middle = (low + high) / 2;
  const int bottom = vertex_nearest(mesh, {middle[0], low[1], middle[2]});
  const int top = vertex_nearest(mesh, {middle[0], high[1], middle[2]});
  Gesture gesture;
  gesture.add(bottom, mesh.positions.row(bottom));
  gesture.add(top, mesh.positions.row(top).transpose() + lift);
  return gesture;
}

double deviation(const Positions& a, const Positions& b) {
  return (a - b).rowwise().norm().maxCoeff() / box_diagonal(a);
}

TEST(Reshape, MovesTheHandlesAndKeepsTheNormals) {
  const Mesh mesh = part();
  const Gesture gesture = lift_top(mesh, {0, 0.5, 0});
  const ReshapeResult result = reshape(mesh.positions, mesh.triangles, gesture);
  for (const auto& [vertex, target] : gesture.targets) {
    EXPECT_LT((result.positions.row(vertex).transpose() - target).norm(), 1e-3);
  }
  // A cylinder made longer is a cylinder: its side stays as wide within a tenth.
  const double radius = result.positions.col(0).maxCoeff();
  EXPECT_NEAR(radius, 0.5, 0.05);
}

TEST(Reshape, WithoutAGestureNothingMoves) {
  for (const Mesh& mesh : {part(), test::sphere(0.5, 2), test::box({1, 2, 3}, 4), test::torus(1, 0.4, 16, 8)}) {
    const ReshapeResult result = reshape(mesh.positions, mesh.triangles, lift_top(mesh, {0, 0, 0}));
    EXPECT_LT(deviation(mesh.positions, result.positions), 1e-12);
  }
}

TEST(Reshape, CommutesWithTranslationAndUniformScale) {
  const Mesh mesh = part();
  const Positions plain = reshape(mesh.positions, mesh.triangles, lift_top(mesh, {0.1, 0.4, 0})).positions;
  for (const double scale : {1e-3, 1e3}) {
    const Eigen::Vector3d moved(3 * scale, -2 * scale, scale);
    const Mesh other = test::transformed(mesh, scale, moved);
    const Positions result =
        reshape(other.positions, other.triangles, lift_top(other, Eigen::Vector3d(0.1, 0.4, 0) * scale)).positions;
    EXPECT_LT(deviation(result, (scale * plain).rowwise() + moved.transpose()), 1e-9) << "scale " << scale;
  }
}

TEST(Reshape, OrderOfVerticesAndTrianglesDoesNotMatter) {
  const Mesh mesh = part();
  const Gesture gesture = lift_top(mesh, {0.1, 0.4, 0});
  const ReshapeResult plain = reshape(mesh.positions, mesh.triangles, gesture);

  std::mt19937 random(5);
  std::vector<int> place(static_cast<size_t>(mesh.positions.rows()));
  std::iota(place.begin(), place.end(), 0);
  std::shuffle(place.begin(), place.end(), random);
  Mesh shuffled = mesh;
  for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v) {
    shuffled.positions.row(place[static_cast<size_t>(v)]) = mesh.positions.row(v);
  }
  std::vector<int> order(static_cast<size_t>(mesh.triangles.rows()));
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), random);
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      shuffled.triangles(order[static_cast<size_t>(t)], (k + static_cast<int>(t)) % 3) =
          place[static_cast<size_t>(mesh.triangles(t, k))];
    }
  }
  Gesture renamed;
  for (const auto& [vertex, target] : gesture.targets) renamed.add(place[static_cast<size_t>(vertex)], target);

  const ReshapeResult result = reshape(shuffled.positions, shuffled.triangles, renamed);
  EXPECT_EQ(result.report.passes, plain.report.passes);
  const Positions back = result.positions(place, Eigen::all);
  // Passes stop near their minima, and rounding decides where.
  EXPECT_LT(deviation(plain.positions, back), 1e-8);
}

TEST(Reshape, SolvingAgainGivesTheSameBytes) {
  const Mesh mesh = part();
  Reshape prepared(mesh.positions, mesh.triangles);
  const Gesture gesture = lift_top(mesh, {0, 0.3, 0.1});
  const Positions first = prepared.solve(gesture).positions;
  prepared.solve(lift_top(mesh, {0.3, 0, 0}));
  EXPECT_EQ(prepared.solve(gesture).positions, first);
  EXPECT_EQ(reshape(mesh.positions, mesh.triangles, gesture).positions, first);
}

TEST(Reshape, RefactoringEveryPassChangesNothing) {
  const Mesh mesh = part();
  const Gesture gesture = lift_top(mesh, {0, 0.3, 0});
  ReshapeOptions options;
  auto result = [&](bool every_pass) {
    options.refactor_every_pass = every_pass;
    return reshape(mesh.positions, mesh.triangles, gesture, options).positions;
  };
  // Steady passes are otherwise solved near their minima.
  EXPECT_LT(deviation(result(true), result(false)), 1e-7);
  options.solver = ReshapeSolver::published;
  EXPECT_EQ(result(true), result(false));
}

#ifdef _OPENMP
TEST(Reshape, AnyThreadCountGivesTheSameBytes) {
  const Mesh mesh = part();
  const Gesture gesture = lift_top(mesh, {0.2, 0.3, 0});
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const Positions alone = reshape(mesh.positions, mesh.triangles, gesture).positions;
  for (const int count : {2, 3, 7}) {
    omp_set_num_threads(count);
    EXPECT_EQ(reshape(mesh.positions, mesh.triangles, gesture).positions, alone) << count << " threads";
  }
  omp_set_num_threads(threads);
}
#endif

TEST(Reshape, TakesRowAndColumnMajorMatrices) {
  const Mesh mesh = part();
  const Gesture gesture = lift_top(mesh, {0, 0.3, 0});
  const Eigen::MatrixXd positions = mesh.positions;
  const Eigen::MatrixXi triangles = mesh.triangles;
  EXPECT_EQ(reshape(positions, triangles, gesture).positions,
            reshape(mesh.positions, mesh.triangles, gesture).positions);
}

TEST(Reshape, AnotherResolutionGivesTheSameShape) {
  const Mesh coarse = test::cylinder(0.5, 1, 40, 12), fine = test::subdivided(coarse);
  ReshapeOptions options;
  options.unit_box_curvatures = curvature(unit_box(coarse.positions).into(coarse.positions), coarse.triangles);
  const Gesture gesture = lift_top(coarse, {0.1, 0.5, 0});
  const Positions expected = reshape(coarse.positions, coarse.triangles, gesture, options).positions;
  Curvatures inherited(fine.triangles.rows(), 2);
  for (Eigen::Index t = 0; t < inherited.rows(); ++t) inherited.row(t) = options.unit_box_curvatures->row(t / 4);
  options.unit_box_curvatures = inherited;
  const Positions result = reshape(fine.positions, fine.triangles, gesture, options).positions;
  const test::Deviation apart = test::deviation(expected, result);
  EXPECT_LT(apart.mean, 0.005);
  EXPECT_LT(apart.largest, 0.015);
}

TEST(Reshape, OneMorePassOfASteadyResultMovesNothing) {
  const Mesh mesh = part();
  const Report report = reshape(mesh.positions, mesh.triangles, lift_top(mesh, {0, 0.5, 0})).report;
  EXPECT_EQ(report.stop, Termination::moved_little);
  EXPECT_LT(report.movements.back(),
            1e-3 * mean_edge_length(unit_box(mesh.positions).into(mesh.positions), mesh.triangles));
}

TEST(Reshape, TheSolversOwnWeightsAreUsedWhereNoneAreGiven) {
  const Mesh mesh = part();
  const Gesture gesture = lift_top(mesh, {0.1, 0.3, 0});
  ReshapeOptions own, given;
  own.solver = given.solver = ReshapeSolver::published;
  given.weights = ReshapeWeights::published();
  EXPECT_EQ(reshape(mesh.positions, mesh.triangles, gesture, own).positions,
            reshape(mesh.positions, mesh.triangles, gesture, given).positions);
  given.weights = ReshapeWeights();
  EXPECT_NE(reshape(mesh.positions, mesh.triangles, gesture, own).positions,
            reshape(mesh.positions, mesh.triangles, gesture, given).positions);
}

/// Of a chain's vertex from the line through its ends.
double distance_to_chord(const Positions& positions, const std::vector<int>& chain, size_t i) {
  const Eigen::Vector3d from = positions.row(chain.front()), to = positions.row(chain.back());
  const Eigen::Vector3d along = (to - from).normalized(), offset = positions.row(chain[i]).transpose() - from;
  return (offset - along * along.dot(offset)).norm();
}

TEST(Reshape, StraightChainsStayStraight) {
  const Mesh mesh = test::box({1, 1, 1}, 6);
  std::vector<int> chain;
  for (int i = 0; i <= 6; ++i) chain.push_back(vertex_nearest(mesh, {i / 6.0, 1, 1}));
  Gesture gesture = lift_top(mesh, {0, 0, 0});
  gesture.add(chain[3], mesh.positions.row(chain[3]).transpose() + Eigen::Vector3d(0, 0.3, 0));
  const auto bend = [&](const Positions& positions) { return distance_to_chord(positions, chain, 3); };
  ReshapeOptions straight;
  straight.straight_chains = {chain};
  const double free = bend(reshape(mesh.positions, mesh.triangles, gesture).positions);
  const double held = bend(reshape(mesh.positions, mesh.triangles, gesture, straight).positions);
  EXPECT_LT(held, 0.01);
  EXPECT_LT(held, free / 3);
}

TEST(Reshape, ANeedleBesideAStraightChainLeavesItSolvable) {
  Mesh mesh = test::box({1, 1, 1}, 6);
  std::vector<int> chain;
  for (int i = 0; i <= 6; ++i) chain.push_back(vertex_nearest(mesh, {i / 6.0, 1, 1}));
  for (const size_t near : {2U, 4U}) mesh.positions(chain[near], 0) = mesh.positions(chain[near - 1], 0) + 3e-6;
  ReshapeOptions straight;
  straight.remesh = When::never;
  straight.straight_chains = {chain};
  const ReshapeResult result = reshape(mesh.positions, mesh.triangles, lift_top(mesh, {0.2, 0.3, 0}), straight);
  EXPECT_EQ(result.report.stop, Termination::moved_little);
  for (size_t i = 1; i + 1 < chain.size(); ++i) EXPECT_LT(distance_to_chord(result.positions, chain, i), 0.01);
}

TEST(Reshape, AComponentThatIsHeldStays) {
  const Mesh one = test::box({1, 1, 1}, 3);
  const Mesh two = test::joined(one, test::transformed(one, 1, {3, 0, 0}));
  Gesture gesture = lift_top(one, {0, 0.5, 0});
  const int other = static_cast<int>(one.positions.rows());
  gesture.add(other, two.positions.row(other));
  const Positions result = reshape(two.positions, two.triangles, gesture).positions;
  EXPECT_TRUE(result.allFinite());
  // The second has one handle, at rest; what else holds it is weak.
  EXPECT_LT((result - two.positions).bottomRows(one.positions.rows()).rowwise().norm().maxCoeff(), 0.02);
}

TEST(Reshape, AFlatteningGestureStaysFinite) {
  const Mesh mesh = test::box({1, 1, 1}, 4);
  Gesture flat;
  for (int v = 0; v < mesh.positions.rows(); ++v) flat.add(v, {mesh.positions(v, 0), 0, mesh.positions(v, 2)});
  const ReshapeResult result = reshape(mesh.positions, mesh.triangles, flat);
  EXPECT_TRUE(result.positions.allFinite());
  EXPECT_LT(result.positions.col(1).cwiseAbs().maxCoeff(), 1e-2);
  Gesture point;
  for (int v = 0; v < mesh.positions.rows(); ++v) point.add(v, {0, 0, 0});
  const ReshapeResult collapsed = reshape(mesh.positions, mesh.triangles, point);
  EXPECT_TRUE(collapsed.positions.allFinite());
}

TEST(Reshape, ProgressNeverFallsAndEndsAtACancel) {
  const Mesh mesh = part();
  const Gesture gesture = lift_top(mesh, {0, 0.5, 0});
  double last = 0;
  const ReshapeResult whole = reshape(mesh.positions, mesh.triangles, gesture, {}, [&](const Progress& p) {
    EXPECT_GE(p.fraction, last);
    EXPECT_LE(p.fraction, 1);
    last = p.fraction;
    return true;
  });
  EXPECT_GT(last, 0);
  ASSERT_GT(whole.report.passes, 3);

  ReshapeOptions two_passes;
  two_passes.pass_limit = 2;
  const ReshapeResult cut =
      reshape(mesh.positions, mesh.triangles, gesture, {}, [](const Progress& p) { return p.pass < 2; });
  EXPECT_EQ(cut.report.stop, Termination::cancelled);
  EXPECT_EQ(cut.positions, reshape(mesh.positions, mesh.triangles, gesture, two_passes).unfinished);
}

TEST(Reshape, ACancelledPreparationLeavesTheMeshAndGoesOnLater) {
  const Mesh mesh = part();
  const Gesture gesture = lift_top(mesh, {0, 0.5, 0});
  Reshape prepared(mesh.positions, mesh.triangles);
  const ReshapeResult cancelled = prepared.solve(gesture, [](const Progress&) { return false; });
  EXPECT_EQ(cancelled.report.stop, Termination::cancelled);
  EXPECT_EQ(cancelled.positions, mesh.positions);
  EXPECT_EQ(prepared.solve(gesture).positions, reshape(mesh.positions, mesh.triangles, gesture).positions);
}

TEST(Reshape, TheEnergyIsTheSumOfItsTerms) {
  const Mesh mesh = part();
  const Report report = reshape(mesh.positions, mesh.triangles, lift_top(mesh, {0, 0.5, 0})).report;
  double total = 0;
  for (const auto& [name, value] : report.energy_by_term) {
    EXPECT_GE(value, 0) << name;
    total += value;
  }
  EXPECT_NEAR(total, report.energy, 1e-12 * report.energy);
  EXPECT_EQ(report.energies[static_cast<size_t>(report.best_pass)], report.energy);
}

std::string refusal(const Mesh& mesh, const ReshapeOptions& options = {}) {
  try {
    Reshape(mesh.positions, mesh.triangles, options);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ReshapeRefuses, WhatItCannotSolve) {
  Mesh line = test::sphere(1, 1);
  line.positions.rightCols<2>().setZero();
  EXPECT_NE(refusal(line).find("none of 80 has any area"), std::string::npos) << refusal(line);
  Mesh point = test::sphere(1, 1);
  point.positions.setOnes();
  EXPECT_NE(refusal(point).find("all vertices are at one point"), std::string::npos);
  Mesh lost = test::sphere(1, 1);
  lost.triangles(3, 1) = 99999;
  EXPECT_NE(refusal(lost).find("triangle 3 names vertex 99999"), std::string::npos);
  Mesh undefined = test::sphere(1, 1);
  undefined.positions(7, 2) = std::nan("");
  EXPECT_NE(refusal(undefined).find("vertex 7"), std::string::npos);
  EXPECT_NE(refusal(Mesh{}).find("no vertices"), std::string::npos);
}

TEST(ReshapeRefuses, OptionsOutOfRange) {
  const Mesh mesh = test::sphere(1, 1);
  ReshapeOptions options;
  options.weights.emplace().normal = -1;
  EXPECT_NE(refusal(mesh, options).find("weights"), std::string::npos);
  options = {};
  options.weights.emplace().regularizer = 0;
  EXPECT_NE(refusal(mesh, options).find("regularizer"), std::string::npos);
  options = {};
  options.feature_angle = 4;
  EXPECT_NE(refusal(mesh, options).find("feature_angle"), std::string::npos);
  options = {};
  options.pass_limit = 0;
  EXPECT_NE(refusal(mesh, options).find("pass_limit"), std::string::npos);
  options = {};
  options.movement = 0;
  EXPECT_NE(refusal(mesh, options).find("movement"), std::string::npos);
  options = {};
  options.acceleration_window = -1;
  EXPECT_NE(refusal(mesh, options).find("acceleration_window"), std::string::npos);
  options = {};
  options.unit_box_curvatures = Curvatures::Zero(3, 2);
  EXPECT_NE(refusal(mesh, options).find("unit_box_curvatures"), std::string::npos);
  options = {};
  options.straight_chains = {{0, 0}};
  EXPECT_NE(refusal(mesh, options).find("not joined by an edge"), std::string::npos);
  options.straight_chains = {{0, -4}};
  EXPECT_NE(refusal(mesh, options).find("not joined by an edge"), std::string::npos);
}

TEST(ReshapeRefuses, AGestureThatDoesNotHoldTheMesh) {
  const Mesh mesh = test::sphere(1, 1);
  Reshape prepared(mesh.positions, mesh.triangles);
  EXPECT_THROW(prepared.solve({}), InvalidInput);
  Gesture beyond;
  beyond.add(100000, {0, 0, 0});
  EXPECT_THROW(prepared.solve(beyond), InvalidInput);
}

}  // namespace
}  // namespace swage
