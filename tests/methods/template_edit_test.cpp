// Meshes that follow their templates: what template_edit.h promises.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "edit_plan.h"
#include "shapes.h"
#include "swage/error.h"
#include "swage/template_edit.h"

namespace swage::test {
namespace {

using Eigen::Index;
using Eigen::RowVector3d;
using Eigen::VectorXd;

struct Fitted {
  Template of;
  VectorXd parameters;
  Mesh mesh;
};

/// A shipped template and the surface that it is by default.
Fitted shipped(const char* name, int resolution = 40) {
  Template of = shipped_template(name);
  VectorXd parameters = of.defaults();
  Mesh mesh = template_mesh(of, parameters, {resolution, nullptr});
  return {std::move(of), std::move(parameters), std::move(mesh)};
}

VectorXd with(const Fitted& fitted, const char* name, double value) {
  VectorXd parameters = fitted.parameters;
  parameters[fitted.of.parameter(name)] = value;
  return parameters;
}

TemplateEdit edit_of(const Fitted& fitted, const TemplateEditOptions& options = {}) {
  return {fitted.of, fitted.parameters, {}, fitted.mesh.positions, fitted.mesh.triangles, options};
}

/// The largest distance between vertices, in diagonals of the first.
double apart(const Positions& a, const Positions& b) { return (a - b).rowwise().norm().maxCoeff() / box_diagonal(a); }

RowVector3d extents(const Positions& positions) {
  return positions.colwise().maxCoeff() - positions.colwise().minCoeff();
}

/// A shipped template that further parameters move as a whole: x, turn in degrees about an axis.
Template movable(const char* name) {
  nlohmann::json file = nlohmann::json::parse(shipped_template(name).text());
  file["parameters"].push_back({{"name", "x"}, {"default", 0}, {"min", -9}, {"max", 9}});
  file["parameters"].push_back({{"name", "turn"}, {"default", 0}, {"min", -180}, {"max", 180}});
  file["nodes"].push_back(
      {{"id", "turned"}, {"type", "rotate"}, {"of", file["root"]}, {"direction", {1, 2, 0.5}}, {"angle", "turn"}});
  file["nodes"].push_back({{"id", "moved"}, {"type", "translate"}, {"of", "turned"}, {"by", {"x", 0, "-x / 2"}}});
  file["root"] = "moved";
  return parse_template(file.dump(), "movable");
}

TEST(TemplateEdit, LeavesTheMeshWhereNothingChanges) {
  for (const char* name : {"couch", "chair", "mug"}) {
    const Fitted fitted = shipped(name);
    TemplatePose pose{0.01, Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 1, 0).normalized()).matrix(), {0.5, -2, 1}};
    const Positions placed = pose.back(fitted.mesh.positions);
    TemplateEdit edit(fitted.of, fitted.parameters, pose, placed, fitted.mesh.triangles);
    const TemplateEditResult result = edit.solve(fitted.parameters);
    EXPECT_LT(apart(placed, result.positions), 1e-9) << name;
    EXPECT_EQ(result.report.stop, Termination::moved_little);
    EXPECT_EQ(result.flipped, 0);
    EXPECT_LT(result.largest, 1e-9);
  }
}

constexpr double kWholeStray = 1e-4;
constexpr double kLargestGap = 0.015;  // 0.005 is what is aimed at.

TEST(TemplateEdit, MovesAndTurnsWithTheWholeTemplate) {
  Fitted fitted{movable("couch"), {}, {}};
  fitted.parameters = fitted.of.defaults();
  fitted.mesh = template_mesh(fitted.of, fitted.parameters, {32, nullptr});
  TemplateEditOptions options;
  options.tolerance = 1e-7;
  TemplateEdit edit = edit_of(fitted, options);
  const Positions shifted = fitted.mesh.positions.rowwise() + RowVector3d(1.5, 0, -0.75);
  EXPECT_LT(apart(shifted, edit.solve(with(fitted, "x", 1.5)).positions), kWholeStray);
  const Eigen::AngleAxisd turn(std::numbers::pi / 3, Eigen::Vector3d(1, 2, 0.5).normalized());
  const Positions turned = fitted.mesh.positions * turn.matrix().transpose();
  EXPECT_LT(apart(turned, edit.solve(with(fitted, "turn", 60)).positions), kWholeStray);
}

TEST(TemplateEdit, DoublesACouch) {
  const Fitted couch = shipped("couch", 56);
  TemplateEdit edit = edit_of(couch);
  const double width = couch.parameters[couch.of.parameter("width")];
  const TemplateEditResult result = edit.solve(with(couch, "width", 2 * width));
  EXPECT_LT(result.residual, 5e-4);
  EXPECT_LT(result.largest, kLargestGap);
  EXPECT_EQ(result.flipped, 0);
  const Mesh target = template_mesh(couch.of, with(couch, "width", 2 * width), {56, nullptr});
  EXPECT_LT((extents(result.positions) - extents(target.positions)).norm(), 0.01 * width);
}

/// ARAP maps in place of the local_map step's, on the same tracking, leave far more behind.
TEST(TemplateEdit, StretchesWhereRotationsDoNot) {
  const Fitted couch = shipped("couch", 40);
  const VectorXd target = with(couch, "width", 2 * couch.parameters[couch.of.parameter("width")]);
  const auto residual_by = [&](EditMaps kind) {
    const auto plan = plan_of(couch.of, couch.parameters, {}, couch.mesh.positions, couch.mesh.triangles, {});
    plan->kind = kind;
    prepare(*plan, {});
    return result_of(*plan, target, advance(*plan, target, {})).residual;
  };
  EXPECT_GT(residual_by(EditMaps::rotated), 2 * residual_by(EditMaps::stretched));
}

TEST(TemplateEdit, ComesCloserWhileItIsDragged) {
  const Fitted couch = shipped("couch", 32);
  TemplateEdit edit = edit_of(couch);
  const VectorXd target = with(couch, "width", 1.02 * couch.parameters[couch.of.parameter("width")]);
  const double first = edit.follow(target).residual;
  EXPECT_LT(edit.follow(target, 10).residual, first);
}

TEST(TemplateEdit, CarriesLooseVertices) {
  Fitted couch = shipped("couch", 32);
  const Index count = couch.mesh.positions.rows();
  couch.mesh.positions.conservativeResize(count + 1, 3);
  couch.mesh.positions.row(count) << 1.1, 0.4, 0;
  TemplateEdit edit = edit_of(couch);
  const TemplateEditResult result = edit.solve(with(couch, "width", 2.4));
  EXPECT_NEAR(result.positions(count, 0), 1.3, 0.05);
  EXPECT_THAT(result.report.warnings, testing::Contains(testing::HasSubstr("no triangle")));
}

TEST(TemplateEdit, EndsWhereItIsCancelled) {
  const Fitted couch = shipped("couch", 24);
  TemplateEdit edit = edit_of(couch);
  const VectorXd target = with(couch, "width", 3);
  const TemplateEditResult none = edit.solve(target, [](const Progress&) { return false; });
  EXPECT_EQ(none.report.stop, Termination::cancelled);
  EXPECT_LT(apart(couch.mesh.positions, none.positions), 1e-12);
}

TEST(TemplateEdit, InterpolatesFromSourceToTarget) {
  const Fitted couch = shipped("couch", 24);
  TemplateEdit edit = edit_of(couch);
  const auto steps = interpolate(edit, couch.parameters, with(couch, "width", 2.4), 3);
  ASSERT_EQ(steps.size(), 3);
  EXPECT_LT(apart(couch.mesh.positions, steps[0].positions), 1e-6);
  EXPECT_LT(extents(steps[1].positions)[0], extents(steps[2].positions)[0]);
  EXPECT_THROW(interpolate(edit, couch.parameters, couch.parameters, 1), InvalidInput);
}

TEST(TemplateEdit, RefusesWhatItCannotDo) {
  const Fitted couch = shipped("couch", 24);
  TemplateEditOptions options;
  options.tracking = 0;
  EXPECT_THROW(edit_of(couch, options), InvalidInput);
  options = {};
  options.tolerance = 1;
  EXPECT_THROW(edit_of(couch, options), InvalidInput);
  TemplateEdit edit = edit_of(couch);
  EXPECT_THROW(edit.solve(VectorXd::Zero(1)), InvalidInput);
  EXPECT_THROW(edit.solve(VectorXd::Constant(couch.parameters.size(), NAN)), InvalidInput);
  EXPECT_THROW(edit.follow(couch.parameters, 0), InvalidInput);
}

}  // namespace
}  // namespace swage::test
