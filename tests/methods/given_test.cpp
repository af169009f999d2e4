// Meshes are solved otherwise than they are given and got.
#include "given.h"

#include <gtest/gtest.h>

#include "as_given.h"
#include "measures.h"
#include "plan.h"
#include "shapes.h"

namespace swage {
namespace {

/// A box with a straight edge, uneven curvatures and a start, all of which have to be put in order with it.
struct GivenProblem {
  Mesh mesh = test::box({1, 2, 0.5}, 6);
  ReshapeOptions options;
  Gesture gesture = test::move_top(mesh, {0.2, 0.6, 0.1});

  GivenProblem() {
    options.unit_box_curvatures = Curvatures::NullaryExpr(
        mesh.triangles.rows(), 2, [](Eigen::Index t, Eigen::Index) { return 0.01 * double(t % 7); });
    std::vector<int> chain;  // Along the y axis.
    for (int v = 0; v < mesh.positions.rows(); ++v) {
      if (mesh.positions(v, 0) == 0 && mesh.positions(v, 2) == 0) chain.push_back(v);
    }
    std::sort(chain.begin(), chain.end(), [&](int a, int b) { return mesh.positions(a, 1) < mesh.positions(b, 1); });
    options.straight_chains = {chain};
  }
};

/// A mesh in order.
struct Ordered {
  Surface surface;
  Given given;

  explicit Ordered(const Mesh& mesh) : surface(surface_of(mesh, 0)), given(mesh, surface, true) {}

  Gesture into(const Gesture& gesture) const {
    Gesture result;
    for (const Hold& hold : given.into(holds_of(gesture))) result.add(hold.vertex(), hold.target.transpose());
    return result;
  }
};

TEST(GivenInOrder, IsTheSameProblem) {
  const GivenProblem problem;
  const Ordered ordered(problem.mesh);
  const Given& order = ordered.given;
  const Mesh& other = ordered.surface.mesh;
  ASSERT_NE(other.positions, problem.mesh.positions);
  Reshape given(problem.mesh.positions, problem.mesh.triangles, problem.options);
  Reshape solved(other.positions, other.triangles, into(order, problem.options));
  const double tolerance = 1e-7;  // Rounding, over all passes.

  const ReshapeResult expected = given.solve(problem.gesture);
  const ReshapeResult result = back(order, solved.solve(ordered.into(problem.gesture)));
  EXPECT_EQ(result.report.passes, expected.report.passes);
  EXPECT_LT((result.positions - expected.positions).cwiseAbs().maxCoeff(), tolerance);
  EXPECT_LT((result.unfinished - expected.unfinished).cwiseAbs().maxCoeff(), tolerance);
  EXPECT_LT((result.transforms - expected.transforms).cwiseAbs().maxCoeff(), 1e3 * tolerance);

  const Gesture next = test::move_top(problem.mesh, {0.25, 0.6, 0.1});
  const ReshapeResult dragged = back(order, solved.solve(ordered.into(next), into(order, result)));
  EXPECT_LT((dragged.positions - given.solve(next, expected).positions).cwiseAbs().maxCoeff(), tolerance);
}

TEST(GivenInOrder, ComesBackAsItWent) {
  const GivenProblem problem;
  const Ordered ordered(problem.mesh);
  const Given& order = ordered.given;
  ReshapeResult result;
  result.positions = result.unfinished = problem.mesh.positions;
  result.transforms = Transforms::Random(problem.mesh.triangles.rows(), 9);
  EXPECT_NE(into(order, result).unfinished, result.unfinished);
  ReshapeResult there = into(order, result);
  there.positions = there.unfinished;
  const ReshapeResult again = back(order, there);
  EXPECT_EQ(again.positions, result.positions);
  EXPECT_EQ(again.unfinished, result.unfinished);
  EXPECT_EQ(again.transforms, result.transforms);
}

/// The mesh with vertex v as v' and triangle t as t', both the numbers backwards.
Mesh backwards(const Mesh& mesh) {
  Mesh result;
  result.positions = mesh.positions.colwise().reverse();
  const auto last = static_cast<int>(mesh.positions.rows()) - 1;
  result.triangles = mesh.triangles.colwise().reverse().unaryExpr([&](int v) { return last - v; });
  return result;
}

TEST(GivenInOrder, LargeMeshesComeBackInTheOrderGiven) {
  const Mesh mesh = test::sphere(0.5, 5), other = backwards(mesh);
  ASSERT_GE(mesh.positions.rows(), 1'000);
  const Gesture gesture = test::move_top(mesh, {0, 0.4, 0});
  Gesture others;
  const auto last = static_cast<int>(mesh.positions.rows()) - 1;
  for (const auto& [vertex, target] : gesture.targets) others.add(last - vertex, target);
  const ReshapeResult result = reshape(mesh.positions, mesh.triangles, gesture);
  const ReshapeResult result_of_other = reshape(other.positions, other.triangles, others);
  const double length = mean_edge_length(mesh.positions, mesh.triangles);
  EXPECT_LT((result_of_other.positions.colwise().reverse() - result.positions).rowwise().norm().maxCoeff(),
            0.05 * length);
  for (const auto& [vertex, target] : gesture.targets) {
    EXPECT_LT((result.positions.row(vertex).transpose() - target).norm(), 0.05);
  }
}

}  // namespace
}  // namespace swage
