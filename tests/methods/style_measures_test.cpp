// What stylizing did, in numbers: against closed forms.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "measures.h"
#include "shapes.h"
#include "swage/error.h"
#include "swage/style_measures.h"
#include "swage/stylize.h"

namespace swage::test {
namespace {

using std::numbers::pi;

StyleMeasures measures_of(const Mesh& mesh) {
  return style_measures(mesh.positions, mesh.triangles, {unit_normals(mesh.positions, mesh.triangles), true});
}

TEST(StyleMeasures, AnglesAreThoseToTheTargets) {
  const Mesh mesh = sheet(4);
  const Eigen::RowVector3d tilted = Eigen::RowVector3d(0, std::sin(0.4), std::cos(0.4)) * 7;
  for (const bool of_triangles : {false, true}) {
    const Eigen::Index count = of_triangles ? mesh.triangles.rows() : mesh.positions.rows();
    GivenNormals targets{tilted.replicate(count, 1), of_triangles};
    const StyleMeasures all = style_measures(mesh.positions, mesh.triangles, targets);
    EXPECT_NEAR(all.angle.mean, 0.4, 1e-12);
    EXPECT_NEAR(all.angle.percentile_95, 0.4, 1e-12);
    EXPECT_NEAR(all.face_angles.maxCoeff(), 0.4, 1e-12);
    EXPECT_EQ(all.face_angles.size(), mesh.triangles.rows());
    // Those without a target count for nothing.
    targets.normals.bottomRows(count - 1).setZero();
    const StyleMeasures one = style_measures(mesh.positions, mesh.triangles, targets);
    EXPECT_NEAR(one.angle.mean, 0.4, 1e-12);
    EXPECT_TRUE(std::isnan(one.face_angles[mesh.triangles.rows() - 1]));
  }
}

TEST(StyleMeasures, AnglesAreWeightedByArea) {
  // Two triangles, one of three times the other's area, 0 and 1 from their targets.
  const Mesh mesh{Positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-3, 0, 0}}, Triangles{{0, 1, 2}, {0, 2, 3}}};
  const GivenNormals targets{Positions{{0, std::sin(1.0), std::cos(1.0)}, {0, 0, 1}}, true};
  const StyleMeasures measures = style_measures(mesh.positions, mesh.triangles, targets);
  EXPECT_NEAR(measures.angle.mean, 0.25, 1e-12);
  EXPECT_NEAR(measures.angle.max, 1, 1e-12);
}

TEST(StyleMeasures, SurfacesThatUnrollAreDevelopable) {
  EXPECT_EQ(measures_of(sheet(5)).developable, 1);
  EXPECT_EQ(measures_of(sphere(1, 3)).developable, 0);
  // A pipe: the side of a cylinder, without its caps.
  Mesh pipe = cylinder(0.5, 1, 24, 6);
  std::vector<int> side;
  for (int t = 0; t < pipe.triangles.rows(); ++t) {
    if (std::abs(unit_normals(pipe.positions, pipe.triangles)(t, 1)) < 0.5) side.push_back(t);
  }
  pipe.triangles = Triangles(pipe.triangles(side, Eigen::all));
  EXPECT_EQ(measures_of(pipe).developable, 1);
}

TEST(StyleMeasures, ABoxUnrollsButAtItsCorners) {
  const Mesh mesh = box({1, 2, 3}, 4);
  double whole = 0, corners = 0;
  for (const auto& triangle : mesh.triangles.rowwise()) {
    const Eigen::Vector3d a = mesh.positions.row(triangle[0]), b = mesh.positions.row(triangle[1]),
                          c = mesh.positions.row(triangle[2]);
    const double third = (b - a).cross(c - a).norm() / 6;
    for (const Eigen::Vector3d& p : {a, b, c}) {
      const bool is_corner = (p[0] == 0 || p[0] == 1) && (p[1] == 0 || p[1] == 2) && (p[2] == 0 || p[2] == 3);
      whole += third;
      corners += is_corner ? third : 0;
    }
  }
  ASSERT_GT(corners, 0);
  EXPECT_NEAR(measures_of(mesh).developable, 1 - corners / whole, 1e-12);
}

TEST(StyleMeasures, QualityIsThatOfTheTriangles) {
  const Mesh halves = sheet(3);
  EXPECT_NEAR(measures_of(halves).quality, std::sqrt(3) / 2, 1e-12);
  EXPECT_NEAR(measures_of(halves).least_angle, pi / 4, 1e-12);
  EXPECT_NEAR(measures_of(halves).low_angle, pi / 4, 1e-12);
  const Mesh equilateral = style_shape(StyleShape::octahedron);
  EXPECT_NEAR(measures_of(equilateral).quality, 1, 1e-12);
  EXPECT_NEAR(measures_of(equilateral).least_angle, pi / 3, 1e-12);
  Mesh needle = halves;
  needle.positions.col(0) *= 100;
  EXPECT_NEAR(measures_of(needle).least_angle, std::atan2(1, 100), 1e-12);
}

TEST(StyleMeasures, TargetsAreOfTheMesh) {
  const Mesh mesh = sheet(2);
  EXPECT_THROW(style_measures(mesh.positions, mesh.triangles, {Positions::Ones(8, 3), false}), InvalidInput);
  EXPECT_THROW(style_measures(mesh.positions, mesh.triangles, {Positions::Ones(9, 3), true}), InvalidInput);
}

/// Of the normals the nearest axis.
Positions axes(const Positions& normals) {
  Positions result = Positions::Zero(normals.rows(), 3);
  for (Eigen::Index i = 0; i < normals.rows(); ++i) {
    Eigen::Index k = 0;
    normals.row(i).cwiseAbs().maxCoeff(&k);
    result(i, k) = normals(i, k) < 0 ? -1 : 1;
  }
  return result;
}

Mesh askew(Mesh mesh) {
  mesh.positions *= Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 0.4, 0.3).normalized()).toRotationMatrix();
  return mesh;
}

TEST(StylizeTargets, AreWhereTheNormalsWereToPoint) {
  const Mesh mesh = askew(sphere(1, 2));
  const ClosestNormals style = closest_normals(style_shape(StyleShape::cube));
  StylizeOptions options;
  options.energy = StylizeEnergy::farap;
  options.pass_limit = 6;
  const StylizeResult result = stylize(mesh.positions, mesh.triangles, style, 10, options);
  EXPECT_TRUE(result.last_targets.of_triangles);
  EXPECT_EQ(result.first_targets.normals.cwiseAbs().rowwise().sum(), Eigen::VectorXd::Ones(mesh.triangles.rows()));
  EXPECT_LT((result.first_targets.normals - axes(unit_normals(mesh.positions, mesh.triangles))).norm(), 1e-12);
  options.pass_limit = 5;
  const StylizeResult before = stylize(mesh.positions, mesh.triangles, style, 10, options);
  EXPECT_LT((result.last_targets.normals - axes(unit_normals(before.positions, mesh.triangles))).norm(), 1e-12);

  options.energy = StylizeEnergy::arap;
  const StylizeResult of_vertices = stylize(mesh.positions, mesh.triangles, style, 10, options);
  EXPECT_FALSE(of_vertices.last_targets.of_triangles);
  // A sphere's normals are its positions.
  EXPECT_LT((of_vertices.first_targets.normals - axes(mesh.positions)).norm(), 1e-12);
}

TEST(StylizeTargets, FollowTheTrianglesAsGiven) {
  // Some triangles turned over, one there twice, one without area, and vertices twice.
  Mesh mesh = joined(askew(sphere(1, 1)), askew(sphere(1, 1)));
  mesh.triangles = Triangles(mesh.triangles.topRows(82));
  mesh.triangles.row(80) = mesh.triangles.row(3);
  mesh.triangles.row(81) << 0, 1, 1;
  for (const int t : {5, 6, 40}) std::swap(mesh.triangles(t, 0), mesh.triangles(t, 1));
  StylizeOptions options;
  options.energy = StylizeEnergy::farap;
  const Positions own = unit_normals(mesh.positions, mesh.triangles);
  const StylizeResult still = stylize(mesh.positions, mesh.triangles, GivenNormals{own, true}, 10, options);
  EXPECT_LT((still.positions - mesh.positions).cwiseAbs().maxCoeff(), 1e-9);
  for (const StylizeEnergy energy : {StylizeEnergy::arap, StylizeEnergy::farap}) {
    options.energy = energy;
    const StylizeResult result = stylize(mesh.positions, mesh.triangles, GivenNormals{own, true}, 10, options);
    const GivenNormals& targets = result.last_targets;
    const StyleMeasures measures = style_measures(mesh.positions, mesh.triangles, targets);
    if (targets.of_triangles) {
      EXPECT_LT((targets.normals - own).topRows(80).norm(), 1e-12);
      EXPECT_LT(measures.angle.max, 1e-6);
      EXPECT_TRUE(targets.normals.bottomRows(1).isZero(0)) << "it has no area";
    } else {
      EXPECT_LT((targets.normals.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-12);
      EXPECT_EQ(targets.normals.topRows(42), targets.normals.bottomRows(42)) << "they are at the same places";
    }
  }
}

}  // namespace
}  // namespace swage::test
