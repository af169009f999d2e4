#include "shape_quality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "places.h"
#include "shapes.h"
#include "swage/mesh_io.h"

namespace swage {
namespace {

ShapeQuality quality_of(const Mesh& mesh) { return shape_quality(mesh.positions, mesh.triangles); }
bool is_bad(const Mesh& mesh) { return badly_shaped(quality_of(mesh)); }

TEST(ShapeQuality, OfAnEquilateralAndANeedle) {
  Mesh mesh{Positions(5, 3), Triangles(2, 3)};
  mesh.positions << 0, 0, 0, 1, 0, 0, 0.5, std::sqrt(0.75), 0, 1.1, 0, 0, 2, 0, 0;
  mesh.positions.row(3) << 0.5, -0.05, 0;
  mesh.positions.row(4) << 100, 100, 100;  // Of no triangle.
  mesh.triangles << 0, 1, 2, 0, 3, 1;
  const ShapeQuality quality = quality_of(mesh);
  const double side = std::hypot(0.5, 0.05), mean = (4 + 2 * side) / 6;
  EXPECT_EQ(quality.triangles, 2);
  EXPECT_NEAR(quality.low_angle, std::atan(0.1), 1e-12);
  EXPECT_NEAR(quality.sharp_area, 0.025 / (0.025 + std::sqrt(0.75) / 2), 1e-12);
  EXPECT_NEAR(quality.longest_over_mean, 1 / mean, 1e-12);
  EXPECT_NEAR(quality.mean_over_diagonal, mean / std::hypot(1, std::sqrt(0.75) + 0.05), 1e-12);
}

TEST(ShapeQuality, NeedlesCoarseAndUnevenMeshesAreBad) {
  EXPECT_FALSE(is_bad(test::sphere(1, 3)));
  EXPECT_FALSE(is_bad(test::cylinder()));
  EXPECT_FALSE(is_bad(test::box({1, 1, 1}, 12)));
  EXPECT_TRUE(is_bad(test::box({1, 1, 1}, 1)));
  EXPECT_TRUE(is_bad(test::cylinder(0.5, 4, 64, 1)));
  EXPECT_TRUE(is_bad(test::joined(test::sphere(0.01, 4), test::box({1, 1, 1}, 6))));
  EXPECT_TRUE(is_bad({Positions(0, 3), Triangles(0, 3)}));
}

TEST(ShapeQuality, TrianglesWithoutAreaAreNotANumber) {
  Mesh mesh = test::sphere(1, 2);
  mesh.triangles.row(0).setConstant(3);
  const ShapeQuality quality = quality_of(mesh);
  EXPECT_TRUE(std::isfinite(quality.sharp_area) && std::isfinite(quality.low_angle));
  const ShapeQuality flat = quality_of({Positions::Zero(3, 3), Triangles{{0, 1, 2}}});
  EXPECT_EQ(flat.low_angle, 0);
  EXPECT_TRUE(badly_shaped(flat));
}

/// Of the corpus those of a class that are bad.
std::vector<std::string> bad_of(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(test::shared("data/meshes/" + folder))) {
    if (is_bad(read_mesh(entry.path()).mesh)) names.push_back(entry.path().filename());
  }
  std::sort(names.begin(), names.end());
  return names;
}

TEST(ShapeQuality, TellsTheClassesOfRealModelsApart) {
  if (!test::has_shared()) GTEST_SKIP() << "no real meshes here";
  EXPECT_EQ(bad_of("A_closed_manifold"), (std::vector<std::string>{"helmet.off", "turbine.off"}));
  EXPECT_EQ(bad_of("B_open_manifold"), std::vector<std::string>());
  EXPECT_EQ(bad_of("E_bad_shape").size(), 68U);
}

}  // namespace
}  // namespace swage
