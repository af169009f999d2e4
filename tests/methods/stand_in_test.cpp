// Meshes solved by a remeshed stand-in, and components joined by a scaffold.
#include "stand_in.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "edit_measures.h"
#include "remesher.h"
#include "shapes.h"
#include "swage/error.h"
#include "tetrahedra.h"

namespace swage {
namespace {

using testing::HasSubstr;

ReshapeOptions with_remesh(When when) {
  ReshapeOptions options;
  options.remesh = when;
  options.stand_in_triangles = 3000;
  return options;
}

ReshapeResult reshaped_near(const Mesh& mesh, const Gesture& gesture, const ReshapeOptions& options) {
  return reshape(mesh.positions, mesh.triangles, gesture, options);
}

/// A cylinder of strips from top to bottom.
Mesh needles() { return test::cylinder(0.5, 1, 64, 1); }

class StandInFor : public testing::Test {
  void SetUp() override {
    if (!has_cgal()) GTEST_SKIP() << "built without CGAL";
  }
};

TEST_F(StandInFor, AWellShapedMeshAgreesWithTheMeshItself) {
  const Mesh mesh = test::cylinder(0.5, 1, 32, 10);
  const Gesture gesture = test::move_top(mesh, {0, 0.3, 0});
  const ReshapeResult direct = reshaped_near(mesh, gesture, {});
  const ReshapeResult carried = reshaped_near(mesh, gesture, with_remesh(When::always));
  ASSERT_NE(carried.stand_in, nullptr);
  EXPECT_LT((direct.positions - carried.positions).rowwise().norm().mean(), 0.01 * box_diagonal(mesh.positions));
}

TEST_F(StandInFor, AnIdentityGestureReturnsTheMesh) {
  const Mesh mesh = needles();
  const ReshapeResult result = reshaped_near(mesh, test::move_top(mesh, {0, 0, 0}), with_remesh(When::always));
  EXPECT_LT((result.positions - mesh.positions).rowwise().norm().maxCoeff(), 1e-6 * box_diagonal(mesh.positions));
}

TEST_F(StandInFor, NeedlesIsTakenByItself) {
  const Mesh mesh = needles();
  Gesture gesture;
  for (int v = 0; v < mesh.positions.rows(); ++v) {
    const double y = mesh.positions(v, 1);
    gesture.add(v, mesh.positions.row(v) + Eigen::RowVector3d(0, y > 0.5 ? 0.4 : 0, 0));
  }
  const ReshapeResult result = reshaped_near(mesh, gesture, with_remesh(When::automatic));
  EXPECT_THAT(result.report.paths.at("mesh"), HasSubstr("remeshed"));
  EXPECT_LT(test::handle_error(mesh, gesture, result.positions), 0.01);
  EXPECT_LT(test::mean_normal_change(mesh, result.positions), 1);
  const Mesh good = test::cylinder(0.5, 1, 32, 10);
  const ReshapeResult direct = reshaped_near(good, test::move_top(good, {0, 0.1, 0}), with_remesh(When::automatic));
  EXPECT_EQ(direct.stand_in, nullptr);
  EXPECT_THAT(direct.report.paths.at("mesh"), HasSubstr("well shaped"));
}

TEST_F(StandInFor, GesturesGoOnFromItsResults) {
  const Mesh mesh = needles();
  Reshape prepared(mesh.positions, mesh.triangles, with_remesh(When::always));
  const ReshapeResult first = prepared.solve(test::move_top(mesh, {0, 0.3, 0}));
  const Gesture next = test::move_top(mesh, {0, 0.32, 0});
  const ReshapeResult cold = prepared.solve(next), warm = prepared.solve(next, first);
  EXPECT_LT(warm.report.passes, cold.report.passes);
  EXPECT_LT((warm.positions - cold.positions).rowwise().norm().maxCoeff(), 2e-3);
}

TEST(StandInRefuses, ThePublishedSolver) {
  ReshapeOptions options = with_remesh(When::always);
  options.solver = ReshapeSolver::published;
  const Mesh mesh = test::sphere(1, 2);
  EXPECT_THROW(Reshape(mesh.positions, mesh.triangles, options), InvalidInput);
}

TEST(ScaffoldTies, JoinComponentsApart) {
  if (!has_tetgen()) GTEST_SKIP() << "built without TetGen";
  const Mesh box = test::box({1, 1, 1}, 4);
  const Mesh mesh = test::joined(box, test::transformed(box, 0.5, {1.2, 0.25, 0.25}));
  Gesture gesture;
  for (int v = 0; v < box.positions.rows(); ++v) gesture.add(v, box.positions.row(v) + Eigen::RowVector3d(0, 2, 0));
  const ReshapeResult result = reshaped_near(mesh, gesture, {});
  EXPECT_THAT(result.report.paths.at("components"), HasSubstr("scaffold of"));
  const Positions second = (result.positions - mesh.positions).bottomRows(box.positions.rows());
  EXPECT_LT((second.rowwise() - Eigen::RowVector3d(0, 2, 0)).rowwise().norm().maxCoeff(), 0.1);
  ASSERT_TRUE(result.scaffold.has_value());
  EXPECT_GE(result.scaffold->positions.rows(), mesh.positions.rows() + 8);
  EXPECT_EQ(result.scaffold->positions.topRows(mesh.positions.rows()), result.positions);
  EXPECT_LT(result.scaffold->tetrahedra.maxCoeff(), result.scaffold->positions.rows());
}

TEST(ScaffoldTies, AreLinksWhereNoneAreWanted) {
  const Mesh box = test::box({1, 1, 1}, 3);
  const Mesh mesh = test::joined(box, test::transformed(box, 1, {2, 0, 0}));
  ReshapeOptions options;
  options.scaffold = When::never;
  const ReshapeResult result = reshaped_near(mesh, test::move_top(mesh, {0, 0.1, 0}), options);
  EXPECT_FALSE(result.scaffold.has_value());
  EXPECT_THAT(result.report.paths.at("components"), HasSubstr("links between nearest points"));
}

}  // namespace
}  // namespace swage
