// Meshes that follow their templates: what template_edit.h promises.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "edit_plan.h"
#include "opencl_device.h"
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
double apart(const Positions& a, const Positions& b) {
  return (a - b).rowwise().norm().maxCoeff() / box_diagonal(a);
}

RowVector3d extents(const Positions& positions) {
  return positions.colwise().maxCoeff() - positions.colwise().minCoeff();
}

/// A shipped template that further parameters move as a whole: x, turn in degrees about an axis.
Template movable(const char* name) {
  nlohmann::json file = nlohmann::json::parse(shipped_template(name).text());
  file["parameters"].push_back({{"name", "x"}, {"default", 0}, {"min", -9}, {"max", 9}});
  file["parameters"].push_back({{"name", "turn"}, {"default", 0}, {"min", -180}, {"max", 180}});
  file["nodes"].push_back({{"id", "turned"},
                           {"type", "rotate"},
                           {"of", file["root"]},
                           {"direction", {1, 2, 0.5}},
                           {"angle", "turn"}});
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

TEST(TemplateEdit, MovesAndTurnsWithTheWholeTemplate) {
  Fitted fitted{movable("couch"), {}, {}};
  fitted.parameters = fitted.of.defaults();
  fitted.mesh = template_mesh(fitted.of, fitted.parameters, {32, nullptr});
  TemplateEditOptions options;
  options.tolerance = 1e-7;
  TemplateEdit edit = edit_of(fitted, options);
  const Positions shifted = fitted.mesh.positions.rowwise() + RowVector3d(1.5, 0, -0.75);
  EXPECT_LT(apart(shifted, edit.solve(with(fitted, "x", 1.5)).positions), 1e-4);
  const Eigen::AngleAxisd turn(std::numbers::pi / 3, Eigen::Vector3d(1, 2, 0.5).normalized());
  const Positions turned = fitted.mesh.positions * turn.matrix().transpose();
  EXPECT_LT(apart(turned, edit.solve(with(fitted, "turn", 60)).positions), 1e-4);
}

TEST(TemplateEdit, DoublesACouch) {
  const Fitted couch = shipped("couch", 56);
  TemplateEdit edit = edit_of(couch);
  const double width = couch.parameters[couch.of.parameter("width")];
  const TemplateEditResult result = edit.solve(with(couch, "width", 2 * width));
  EXPECT_LT(result.residual, 5e-4);
  EXPECT_LT(result.largest, 5e-3);
  EXPECT_EQ(result.flipped, 0);
  const Mesh target = template_mesh(couch.of, with(couch, "width", 2 * width), {56, nullptr});
  EXPECT_LT((extents(result.positions) - extents(target.positions)).norm(), 0.01 * width);
}

}  // namespace
}  // namespace swage::test
