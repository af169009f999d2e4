// Templates that are any function of a point.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shapes.h"
#include "swage/error.h"
#include "swage/template_fit.h"

namespace swage::test {
namespace {

using Eigen::VectorXd;

/// A ball of a radius, its middle at x.
Template ball() {
  return template_of("ball", {{"radius", "", "", 1, 0.5, 3}, {"x", "", "", 0, -2, 2}},
                     [](const Positions& points, const VectorXd& parameters, VectorXd& values) {
                       const Eigen::RowVector3d middle(parameters[1], 0, 0);
                       values = (points.rowwise() - middle).rowwise().norm().array() - parameters[0];
                     });
}

TEST(TemplateFunction, HasDerivatives) {
  const Template of = ball();
  const Positions points = Positions::Random(50, 3) * 2;
  const VectorXd parameters = Eigen::Vector2d(0.7, 0.3);
  FieldValues field;
  of.field(*cpu_backend())->evaluate(points, parameters, FieldDerivatives::all, field);
  for (Eigen::Index p = 0; p < points.rows(); ++p) {
    const Eigen::RowVector3d from = points.row(p) - Eigen::RowVector3d(0.3, 0, 0);
    EXPECT_NEAR(field.values[p], from.norm() - 0.7, 1e-12);
    EXPECT_LT((field.gradients.row(p) - from.normalized()).norm(), 1e-6);
    EXPECT_NEAR(field.by_parameters(p, 0), -1, 1e-6);
    EXPECT_NEAR(field.by_parameters(p, 1), -from.normalized()[0], 1e-6);
  }
}

TEST(TemplateFunction, IsMeshedAndFitted) {
  const Template of = ball();
  const VectorXd made = Eigen::Vector2d(0.9, 0.4);
  const Mesh mesh = template_mesh(of, made, {48, nullptr});
  EXPECT_NEAR(volume(mesh), 4 * std::numbers::pi / 3 * std::pow(0.9, 3), 0.02);
  const TemplateFit fit = fit_template(of, mesh.positions, mesh.triangles);
  EXPECT_LT(fit.residual, 1e-3);
  // The pose brings the mesh to the size of the default one.
  EXPECT_NEAR(fit.parameters[0] / fit.pose.scale, 0.9, 5e-3);
}

TEST(TemplateFunction, IsRefusedInWords) {
  const FieldFunction field = [](const Positions&, const VectorXd&, VectorXd& values) { values = VectorXd::Zero(1); };
  const std::vector<TemplateParameter> one = {{"a", "", "", 1, 0, 2}};
  EXPECT_THROW(template_of("none", one, {}), InvalidInput);
  EXPECT_THROW(template_of("up", one, field, 'w'), InvalidInput);
  EXPECT_THROW(template_of("twice", {one[0], one[0]}, field), InvalidInput);
  EXPECT_THROW(template_of("name", {{"1a", "", "", 1, 0, 2}}, field), InvalidInput);
  EXPECT_THROW(template_of("beyond", {{"a", "", "", 3, 0, 2}}, field), InvalidInput);
  EXPECT_THROW(template_of("endless", {{"a", "", "", 3, 0, INFINITY}}, field), InvalidInput);
  const Template of = template_of("short", one, field);
  EXPECT_THROW(of.tape(), InvalidInput);
  EXPECT_THROW(of.text(), InvalidInput);
  EXPECT_THROW(template_mesh(of, of.defaults()), InvalidInput);
}

}  // namespace
}  // namespace swage::test
