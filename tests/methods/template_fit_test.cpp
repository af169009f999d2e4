// Fits from given starts, and of meshes that are not as one would wish.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numbers>
#include <random>

#include "shapes.h"
#include "swage/error.h"
#include "swage/template_fit.h"

namespace swage::test {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

VectorXd values_with(const Template& of, const std::map<std::string, double>& values) {
  VectorXd parameters = of.defaults();
  for (const auto& [name, value] : values) parameters[of.parameter(name)] = value;
  return parameters;
}

/// Every parameter is off by up to 30 % at the start, and within 1 % of its range at the end.
TEST(TemplateFit, FindsTheParametersFromPerturbedStarts) {
  const Template of = shipped_template("box");
  const VectorXd wanted = values_with(of, {{"width", 1.3},
                                           {"height", 1.1},
                                           {"depth", 0.8},
                                           {"x", 0.5},
                                           {"y", -0.4},
                                           {"z", 0.3},
                                           {"rounding", 0.2},
                                           {"taper", 1.3},
                                           {"twist", 30},
                                           {"lean", 0.3},
                                           {"bend", 25}});
  const Mesh mesh = template_mesh(of, wanted, {96, nullptr});
  FitOptions options;
  options.surface_samples = 300;
  options.volume_samples = 100;
  options.least_sigma = 0.03;  // Farther away bent fields are no distances.
  options.pose = TemplatePose{};
  constexpr int kSeeds = 100;
  int found = 0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    std::mt19937 random(static_cast<unsigned>(seed));
    std::uniform_real_distribution<double> factor(0.7, 1.3);
    options.seed = static_cast<unsigned>(seed);
    options.start = wanted;
    for (double& value : options.start) value *= factor(random);
    const TemplateFit fit = fit_template(of, mesh.positions, mesh.triangles, options);
    double most = 0;
    for (Index p = 0; p < wanted.size(); ++p) {
      const TemplateParameter& range = of.parameters()[static_cast<size_t>(p)];
      most = std::max(most, std::abs(fit.parameters[p] - wanted[p]) / (range.most - range.least));
    }
    found += most < 0.01 ? 1 : 0;
  }
  EXPECT_GE(found, 95);
}

Mesh couch() {
  const Template of = shipped_template("couch");
  return template_mesh(of, values_with(of, {{"width", 2.4}, {"arm_width", 0.3}}), {64, nullptr});
}

double diagonal(const Mesh& mesh) {
  return (mesh.positions.colwise().maxCoeff() - mesh.positions.colwise().minCoeff()).norm();
}

TemplateFit fit_couch(const Mesh& mesh) {
  FitOptions options;
  options.surface_samples = 2000;
  return fit_template(shipped_template("couch"), mesh.positions, mesh.triangles, options);
}

TEST(TemplateFit, FindsWhatIsUp) {
  Mesh mesh = couch();
  mesh.positions = (mesh.positions *
                    Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitX()).toRotationMatrix().transpose())
                       .eval();
  const TemplateFit fit = fit_couch(mesh);
  EXPECT_LT(fit.residual, 0.01);
  EXPECT_NEAR(fit.pose.rotation(1, 2), 1, 1e-12);
  EXPECT_THAT(fit.report.warnings, testing::IsEmpty());
}

TEST(TemplateFit, IsOfOpenSurfacesWithAWarning) {
  Mesh mesh = couch();
  const double floor = mesh.positions.col(1).minCoeff() + 0.1 * diagonal(mesh);
  Triangles kept(mesh.triangles.rows(), 3);
  Index count = 0;
  for (Index t = 0; t < mesh.triangles.rows(); ++t) {
    if (mesh.positions(mesh.triangles(t, 0), 1) > floor) kept.row(count++) = mesh.triangles.row(t);
  }
  ASSERT_LT(count, mesh.triangles.rows());
  mesh.triangles = kept.topRows(count);
  const TemplateFit fit = fit_couch(mesh);
  EXPECT_LT(fit.residual, 0.015);
  EXPECT_THAT(fit.report.warnings, testing::Contains(testing::HasSubstr("not closed")));
}

TEST(TemplateFit, IsOfNoisySurfaces) {
  Mesh mesh = couch();
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 0.004 * diagonal(mesh));
  for (double& x : mesh.positions.reshaped()) x += noise(random);
  EXPECT_LT(fit_couch(mesh).residual, 0.012);
}

/// A fin at one edge: its part of the mesh has no inside.
TEST(TemplateFit, IsOfNonManifoldSurfacesWithAWarning) {
  Mesh mesh = couch();
  const Index vertices = mesh.positions.rows(), triangles = mesh.triangles.rows();
  mesh.positions.conservativeResize(vertices + 1, 3);
  mesh.positions.row(vertices) = mesh.positions.row(mesh.triangles(0, 0)) + Eigen::RowVector3d(0, 0.05, 0);
  mesh.triangles.conservativeResize(triangles + 1, 3);
  mesh.triangles.row(triangles) << mesh.triangles(0, 0), mesh.triangles(0, 1), static_cast<int>(vertices);
  const TemplateFit fit = fit_couch(mesh);
  EXPECT_LT(fit.residual, 0.012);
  EXPECT_THAT(fit.report.warnings, testing::Contains(testing::HasSubstr("not closed")));
}

/// Vertices of no triangle say nothing about where the mesh is.
TEST(TemplateFit, SeesNoLooseVertices) {
  Mesh mesh = couch();
  const TemplateFit fit = fit_couch(mesh);
  mesh.positions.conservativeResize(mesh.positions.rows() + 1, 3);
  mesh.positions.row(mesh.positions.rows() - 1) << 1000, 0, 0;
  EXPECT_EQ(fit_couch(mesh).parameters, fit.parameters);
}

TEST(TemplateFit, RefusesStartsAndPosesThatAreNone) {
  const Mesh mesh = sphere();
  const Template of = shipped_template("box");
  const auto refuses = [&](const FitOptions& options) {
    EXPECT_THROW(fit_template(of, mesh.positions, mesh.triangles, options), InvalidInput);
  };
  FitOptions options;
  options.start = VectorXd::Zero(2);
  refuses(options);
  options = {};
  options.up = 'w';
  refuses(options);
  options = {};
  options.pose = TemplatePose{};
  options.pose->scale = 0;
  refuses(options);
  options.pose = TemplatePose{};
  options.pose->rotation *= 2;
  refuses(options);
}

}  // namespace
}  // namespace swage::test
