// Templates as meshes, and fitted to meshes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "shapes.h"
#include "swage/diagnose.h"
#include "swage/error.h"
#include "swage/template_fit.h"

namespace swage::test {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

Template round_template() {
  return parse_template(R"({"version": 1, "name": "ball", "up": "y",
      "parameters": [{"name": "radius", "default": 1, "min": 0.5, "max": 3},
                     {"name": "x", "default": 0, "min": -2, "max": 2}],
      "nodes": [{"id": "round", "type": "sphere", "radius": "radius"},
                {"id": "root", "type": "translate", "of": "round", "by": ["x", 0, 0]}],
      "root": "root"})",
                        "ball");
}

Eigen::RowVector3d extents_of(const Mesh& mesh) {
  return mesh.positions.colwise().maxCoeff() - mesh.positions.colwise().minCoeff();
}

TEST(TemplateMesh, IsTheSurface) {
  const Template of = round_template();
  const Mesh mesh = template_mesh(of, of.defaults(), {64, nullptr});
  const Diagnosis diagnosis = diagnose(mesh.positions, mesh.triangles);
  EXPECT_EQ(diagnosis.boundary_edges.count, 0);
  EXPECT_EQ(diagnosis.inconsistent_edges.count, 0);
  EXPECT_NEAR(volume(mesh), 4 * std::numbers::pi / 3, 0.01);
  EXPECT_LT((mesh.positions.rowwise().norm().array() - 1).abs().maxCoeff(), 0.005);
}

/// Corners of a box are there, and nothing beside them.
TEST(TemplateMesh, KeepsEdgesSharp) {
  const Template of = shipped_template("box");
  VectorXd parameters = of.defaults();
  parameters[of.parameter("rounding")] = 0;
  parameters[of.parameter("depth")] = 2.1;
  const Mesh mesh = template_mesh(of, parameters, {48, nullptr});
  EXPECT_NEAR(volume(mesh), 2.1, 1e-3);
  EXPECT_LT((extents_of(mesh) - Eigen::RowVector3d(1, 1, 2.1)).norm(), 1e-3);
}

TEST(TemplateMesh, IsRefusedOrEmptyInWords) {
  const Template of = round_template();
  EXPECT_THROW(template_mesh(of, VectorXd::Zero(1)), InvalidInput);
  EXPECT_THROW(template_mesh(of, VectorXd::Constant(2, NAN)), InvalidInput);
  EXPECT_THROW(template_mesh(of, of.defaults(), {4, nullptr}), InvalidInput);
  const Template plane = parse_template(
      R"({"version": 1, "name": "plane", "up": "y", "parameters": [],
          "nodes": [{"id": "root", "type": "plane", "normal": [0, 1, 0]}], "root": "root"})",
      "plane");
  EXPECT_THROW(template_mesh(plane, {}), Unsolvable);
  EXPECT_EQ(template_mesh(of, of.defaults(), {}, [](const Progress&) { return false; }).triangles.rows(), 0);
}

class ShippedTemplates : public testing::TestWithParam<std::string> {};

/// Wherever their parameters are: a surface, of a size to be expected, at the defaults closed.
TEST_P(ShippedTemplates, AreSurfacesEverywhere) {
  const Template of = shipped_template(GetParam());
  EXPECT_GE(of.parameters().size(), 8);
  EXPECT_LE(of.parameters().size(), 30);
  const Mesh usual = template_mesh(of, of.defaults(), {48, nullptr});
  EXPECT_EQ(diagnose(usual.positions, usual.triangles, {}, 0).boundary_edges.count, 0);
  std::mt19937 random(1);
  for (int i = 0; i < 20; ++i) {
    VectorXd parameters = of.defaults();
    for (Index p = 0; p < parameters.size(); ++p) {
      const TemplateParameter& range = of.parameters()[static_cast<size_t>(p)];
      const double part = i < 10 ? std::uniform_real_distribution<double>(0, 1)(random)
                                 : std::uniform_int_distribution<int>(0, 1)(random);
      parameters[p] = range.least + part * (range.most - range.least);
    }
    const Mesh mesh = template_mesh(of, parameters, {64, nullptr});
    EXPECT_GT(mesh.triangles.rows(), 50);
    EXPECT_LT(extents_of(mesh).norm(), 30 * extents_of(usual).norm());
  }
}

INSTANTIATE_TEST_SUITE_P(All, ShippedTemplates, testing::ValuesIn(shipped_templates()),
                         [](const auto& instance) { return instance.param; });

TEST(ShippedLamp, LeansAsAWhole) {
  const Template of = shipped_template("lamp");
  VectorXd leaning = of.defaults();
  leaning[of.parameter("lean")] = 0.3;
  const double height = leaning[of.parameter("height")];
  const double shade = height - leaning[of.parameter("shade_height")] / 2;
  const Mesh upright = template_mesh(of, of.defaults(), {64, nullptr}),
             leant = template_mesh(of, leaning, {64, nullptr});
  // Widest is the shade: it has its width still, and its middle is where the stand ends.
  EXPECT_NEAR(extents_of(leant)[2], extents_of(upright)[2], 0.01);
  double left = 1e9, right = -1e9;
  for (const auto& at : leant.positions.rowwise()) {
    if (at[1] < shade - 0.05) continue;
    left = std::min(left, at[0]);
    right = std::max(right, at[0]);
  }
  EXPECT_NEAR((left + right) / 2, 0.3 * shade, 0.01);
}

TEST(ShippedAirplane, HasARoundNose) {
  const Template of = shipped_template("airplane");
  const VectorXd at = of.defaults();
  const double radius = at[of.parameter("radius")], length = at[of.parameter("length")];
  const double nose = at[of.parameter("nose")] * length, start = length / 2 - nose;
  const Mesh mesh = template_mesh(of, at, {128, nullptr});
  int on_nose = 0;
  for (const auto& p : mesh.positions.rowwise()) {
    if (p[0] < start + 0.1) continue;
    const Eigen::Vector3d scaled((p[0] - start) / nose, p[1] / radius, p[2] / radius);
    EXPECT_NEAR(scaled.norm(), 1, 0.02);
    ++on_nose;
  }
  EXPECT_GT(on_nose, 100);
}

TEST(TemplateFit, FindsABallAnywhere) {
  const Template of = round_template();
  Mesh mesh = transformed(sphere(20, 3), 1, {500, -300, 7});
  const TemplateFit fit = fit_template(of, mesh.positions, mesh.triangles);
  EXPECT_LT(fit.residual, 0.003);
  FieldValues field;
  cpu_backend()->field(of.tape())->evaluate(fit.pose.into(mesh.positions), fit.parameters, FieldDerivatives::none,
                                            field);
  EXPECT_LT(field.values.cwiseAbs().maxCoeff(), 0.02);
  EXPECT_LT((fit.pose.back(fit.pose.into(mesh.positions)) - mesh.positions).cwiseAbs().maxCoeff(), 1e-9);
}

/// A meshed template's parameters, from the defaults.
TEST(TemplateFit, FindsTheParametersOfAMeshedTemplate) {
  const Template of = shipped_template("couch");
  VectorXd parameters = of.defaults();
  const auto set = [&](const char* name, double value) { parameters[of.parameter(name)] = value; };
  set("width", 2.4);
  set("back_height", 0.6);
  set("arm_width", 0.3);
  set("leg_height", 0.18);
  const Mesh mesh = template_mesh(of, parameters, {96, nullptr});
  const TemplateFit fit = fit_template(of, mesh.positions, mesh.triangles);
  EXPECT_LT(fit.residual, 0.01);
  const auto found = [&](const char* name) { return fit.parameters[of.parameter(name)] / fit.pose.scale; };
  EXPECT_NEAR(found("width"), 2.4, 0.05);
  EXPECT_NEAR(found("arm_width"), 0.3, 0.03);
}

TEST(TemplateFit, TellsOfSurfacesThatAreNotClosed) {
  const Template of = shipped_template("table");
  const Mesh mesh = sheet(6);
  const TemplateFit fit = fit_template(of, mesh.positions, mesh.triangles);
  EXPECT_THAT(fit.report.warnings, testing::Contains(testing::HasSubstr("not closed")));
  EXPECT_TRUE(fit.parameters.allFinite());
}

TEST(TemplateFit, RefusesWhatItCannotDo) {
  const Template of = round_template();
  const Mesh mesh = sphere();
  FitOptions options;
  options.surface_samples = 3;
  EXPECT_THROW(fit_template(of, mesh.positions, mesh.triangles, options), InvalidInput);
  options = {};
  options.least_sigma = 0;
  EXPECT_THROW(fit_template(of, mesh.positions, mesh.triangles, options), InvalidInput);
  EXPECT_THROW(fit_template(of, mesh.positions, Triangles(0, 3)), InvalidInput);
  EXPECT_EQ(fit_template(of, mesh.positions, mesh.triangles, {}, [](const Progress&) { return false; }).report.stop,
            Termination::cancelled);
}

}  // namespace
}  // namespace swage::test
