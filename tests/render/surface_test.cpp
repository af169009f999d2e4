// How one surface looks: its outline's area, its shading, shadows and lines.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "picture.h"
#include "shapes.h"

namespace swage::test {
namespace {

class Surfaces : public testing::Test {
 protected:
  void SetUp() override {
    if (!can_render()) GTEST_SKIP() << "this build makes no pictures";
  }
};

/// Where the middle of the only spot of such colour is.
Eigen::Vector2d spot(const Image& image, const Region& region, const std::function<bool(const Rgb&)>& is_meant) {
  const Region found = bounds(image, region, is_meant);
  return {(found.x0 + found.x1) / 2.0, (found.y0 + found.y1) / 2.0};
}

HandleMark pin(const Eigen::Vector3d& at) { return {at, at, false}; }

TEST_F(Surfaces, ASphereCoversItsDiscAtTheScaleThatHandlesTell) {
  Panel panel = panel_of(sphere(0.5, 5));
  panel.handles = {pin({-1, 0, 0}), pin({1, 0, 0})};
  const Image image = render({panel}, plain(800, 600));
  const double left = spot(image, {0, 0, 400, 540}, is_red).x(), right = spot(image, {400, 0, 800, 540}, is_red).x();
  const double radius = (right - left) / 2 * 0.5;
  const int dot = 12;
  const int area = count(image, {int(left) + dot, 0, int(right) - dot, 540}, is_ink);
  EXPECT_GT(radius, 80);
  EXPECT_NEAR(area, std::numbers::pi * radius * radius, 0.015 * area);
}

TEST_F(Surfaces, APlaneIsOfOneColourFromBothSides) {
  Panel panel = panel_of(sheet(4));
  RenderOptions options = plain(300, 300);
  options.ambient_rays = 8;
  const Image image = render({panel}, options);
  const Region inside{60, 60, 240, 240};
  const Rgb middle = pixel(image, 150, 150);
  EXPECT_EQ(count(image, inside, [&](const Rgb& c) { return c == middle; }), 180 * 180);
  EXPECT_LT(middle[0], 230);
  EXPECT_GT(middle[0], 150);
  panel.mesh.triangles.row(3).reverseInPlace();
  panel.mesh.triangles.bottomRows(9).col(0).swap(panel.mesh.triangles.bottomRows(9).col(1));
  EXPECT_EQ(render({panel}, options).rgb, image.rgb) << "whichever way triangles wind";
}

TEST_F(Surfaces, ACurvedSurfaceIsSmoothAndACreaseIsNot) {
  RenderOptions options = plain(400, 400);
  const auto largest_step = [&](double feature_angle) {
    options.feature_angle = feature_angle;
    const Image image = render({panel_of(cylinder(0.5, 1, 16, 4))}, options);
    int most = 0;
    for (int x = 110; x < 290; ++x) most = std::max(most, difference(pixel(image, x, 200), pixel(image, x + 1, 200)));
    return most;
  };
  EXPECT_LE(largest_step(std::numbers::pi * 145 / 180), 2);
  EXPECT_GE(largest_step(std::numbers::pi * 170 / 180), 6);
}

/// The floor z = 0, and a wall of the same size on its side y = 1.
Mesh floor_and_wall() {
  Mesh wall = sheet(4);
  wall.positions.col(2) = wall.positions.col(1);
  wall.positions.col(1).setConstant(1);
  return joined(sheet(4), wall);
}

TEST_F(Surfaces, ACornerIsDarkerThanAnOpenFloor) {
  RenderOptions options = plain(400, 500, {0, -1, 1});
  const auto floor_colours = [&] {
    const Image image = render({panel_of(floor_and_wall())}, options);
    const Region all = bounds(image, all_of(image), is_ink);  // The wall above, the floor below, equally high.
    const int height = all.y1 - all.y0, x = (all.x0 + all.x1) / 2;
    return std::pair(pixel(image, x, all.y0 + height * 54 / 100), pixel(image, x, all.y0 + height * 95 / 100));
  };
  const auto [plain_corner, plain_open] = floor_colours();
  EXPECT_EQ(plain_corner, plain_open);
  options.ambient_rays = 16;
  const auto [corner, open] = floor_colours();
  EXPECT_LT(corner[0], open[0] - 20);
  EXPECT_LT(corner[0], plain_corner[0] - 20);
}

TEST_F(Surfaces, LinesAreWhereTheSurfaceIsSharp) {
  RenderOptions options = plain(400, 400, {1, 1, 1});
  const Image without = render({panel_of(box())}, options);
  EXPECT_EQ(count(without, all_of(without), is_dark), 0);
  options.feature_lines = true;
  const Image with = render({panel_of(box())}, options);
  // Three edges meet at the corner (1, 1, 1) in the middle; one of them goes straight down from there.
  for (int y = 205; y < 300; y += 10) EXPECT_EQ(count(with, {195, y, 205, y + 1}, is_dark) > 0, true) << y;
  for (int y = 205; y < 300; y += 10) EXPECT_EQ(count(with, {215, y, 240, y + 1}, is_dark), 0) << y;
  for (int y = 100; y < 190; y += 10) EXPECT_EQ(count(with, {195, y, 205, y + 1}, is_dark), 0) << "hidden: " << y;
}

TEST_F(Surfaces, NothingIsSeenOfWhatIsInside) {
  RenderOptions options = plain(400, 400, {1, 2, 3});
  options.feature_lines = true;
  const Mesh inner = transformed(box(), 0.5, {0.25, 0.25, 0.25});
  EXPECT_EQ(render({panel_of(joined(box(), inner))}, options).rgb, render({panel_of(box())}, options).rgb);
  options.ambient_rays = 8;
  const Mesh beside = transformed(box(), 0.5, {1.25, 0.25, 0.25});
  EXPECT_NE(render({panel_of(joined(box(), beside))}, options).rgb, render({panel_of(box())}, options).rgb);
}

TEST_F(Surfaces, VerticesGivenTwiceMakeNoLine) {
  Mesh mesh = sheet(2);
  const Mesh other = transformed(sheet(2), 1, {1, 0, 0});
  RenderOptions options = plain(400, 300);
  options.feature_lines = true;
  const Image image = render({panel_of(joined(mesh, other))}, options);
  EXPECT_EQ(count(image, {150, 120, 250, 180}, is_dark), 0);
  mesh.positions.col(0).array() -= 0.1;  // Now there is a gap.
  const Image apart = render({panel_of(joined(mesh, other))}, options);
  EXPECT_GT(count(apart, {150, 120, 250, 180}, is_dark), 60);
}

TEST_F(Surfaces, DenseLinesLeaveTheSurfaceInSight) {
  RenderOptions options = plain(300, 300);
  options.feature_lines = true;
  options.feature_angle = std::numbers::pi;  // Every edge that is not quite flat.
  Panel panel = panel_of(sphere(0.5, 5));
  const Image image = render({panel}, options);
  EXPECT_LT(count(image, {100, 100, 200, 200}, is_dark), 1000);
}

}  // namespace
}  // namespace swage::test
