// Meshes whose vertices alone say little: all of a box's corners lie on its template wherever its sides go.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "shapes.h"
#include "swage/template_edit.h"

namespace swage::test {
namespace {

class CornersAlone : public testing::TestWithParam<double> {};

TEST_P(CornersAlone, FollowTheirTemplate) {
  const Template of = shipped_template("box");
  const Mesh cube = box({1, 1, 1}, 1);
  Mesh centred = cube;
  centred.positions.rowwise() -= cube.positions.colwise().mean();
  Eigen::VectorXd parameters = of.defaults();
  parameters[of.parameter("rounding")] = GetParam();
  TemplateEdit edit(of, parameters, {}, centred.positions, centred.triangles);
  Eigen::VectorXd wider = parameters;
  wider[of.parameter("width")] = 1.5;
  const TemplateEditResult result = edit.solve(wider);
  const Eigen::RowVector3d size = result.positions.colwise().maxCoeff() - result.positions.colwise().minCoeff();
  EXPECT_NEAR(size[0], 1.5, 0.02);
  EXPECT_NEAR(size[1], 1, 0.01);
  EXPECT_NEAR(size[2], 1, 0.01);
  EXPECT_EQ(result.positions.rows(), cube.positions.rows());
  EXPECT_EQ(result.flipped, 0);
  EXPECT_LT(result.residual, 5e-4);
}

// Sharp, the field's slope at corners is that of one of three sides.
INSTANTIATE_TEST_SUITE_P(Rounded, CornersAlone, testing::Values(0, 1e-5, 0.02));

TEST(TemplateCoarse, TellsOfTheEdgesGiven) {
  const Template of = shipped_template("box");
  Mesh open = box({1, 1, 1}, 1);
  open.positions.rowwise() -= open.positions.colwise().mean();
  open.triangles.conservativeResize(open.triangles.rows() - 2, 3);
  TemplateEdit edit(of, of.defaults(), {}, open.positions, open.triangles);
  Eigen::VectorXd wider = of.defaults();
  wider[of.parameter("width")] *= 1.1;
  const Report report = edit.solve(wider).report;
  EXPECT_THAT(report.warnings, testing::Contains(testing::HasSubstr("4 edges have one triangle")));
  EXPECT_THAT(report.paths.at("edges"), testing::HasSubstr("split"));
  const TemplateEditResult stopped = edit.solve(wider, [](const Progress&) { return false; });
  EXPECT_EQ(stopped.report.stop, Termination::cancelled);
  EXPECT_EQ(stopped.positions.rows(), open.positions.rows());
  TemplateEdit unprepared(of, of.defaults(), {}, open.positions, open.triangles);
  EXPECT_EQ(unprepared.solve(wider, [](const Progress&) { return false; }).positions.rows(), open.positions.rows());
  const Mesh fine = box({1, 1, 1}, 40);
  const Positions centred = fine.positions.rowwise() - fine.positions.colwise().mean();
  TemplateEdit of_many(of, of.defaults(), {}, centred, fine.triangles);
  EXPECT_EQ(of_many.solve(wider).report.paths.at("edges"), "as given");
}

}  // namespace
}  // namespace swage::test
