// Several meshes on a sheet: scale, handles, colours and words.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "picture.h"
#include "shapes.h"

namespace swage::test {
namespace {

class Sheets : public testing::Test {
 protected:
  void SetUp() override {
    if (!can_render()) GTEST_SKIP() << "this build makes no pictures";
  }
};

TEST_F(Sheets, PanelsAreAtOneScaleAndPlace) {
  const Panel large = panel_of(sphere(1, 4)), small = panel_of(transformed(sphere(0.5, 4), 1, {0.5, 0, 0}));
  const Image image = render({large, small, large}, plain(1200, 400));
  const Region left = bounds(image, {0, 0, 400, 400}, is_ink), middle = bounds(image, {400, 0, 800, 400}, is_ink),
               right = bounds(image, {800, 0, 1200, 400}, is_ink);
  EXPECT_GT(left.x1 - left.x0, 250);
  EXPECT_EQ(left.x1 - left.x0, right.x1 - right.x0);
  EXPECT_NEAR(middle.x1 - middle.x0, (left.x1 - left.x0) / 2.0, 2);
  EXPECT_NEAR(middle.x1, (left.x1 + right.x1) / 2.0, 1) << "their right ends are at one place of their panels";
  EXPECT_NEAR((middle.y0 + middle.y1) / 2.0, (left.y0 + left.y1) / 2.0, 1);
}

TEST_F(Sheets, HandlesAreWhereTheyProjectTo) {
  Panel panel = panel_of(sheet(4));
  panel.handles = {
      {{0, 0, 0}, {0, 0, 0}, false}, {{1, 1, 0}, {1, 1, 0}, false}, {{0.5, 0.25, 0}, {0.5, 0.75, 0}, false}};
  const Image before = render({panel}, plain(600, 600));
  panel.handles[2].reached = true;
  const Image after = render({panel}, plain(600, 600));
  // The sheet's own extent, seen along its middle lines, where there are no dots, gives the scale.
  const Region across = bounds(before, {0, 400, 600, 401}, is_ink), down = bounds(before, {100, 0, 101, 555}, is_ink);
  const auto at = [&](const Image& image, double x, double y) {
    return pixel(image, static_cast<int>(across.x0 + x * (across.x1 - across.x0)),
                 static_cast<int>(down.y1 - y * (down.y1 - down.y0)));
  };
  EXPECT_TRUE(is_red(at(before, 0, 0)));
  EXPECT_TRUE(is_red(at(before, 1, 1)));
  EXPECT_TRUE(is_orange(at(before, 0.5, 0.25))) << "the dot";
  EXPECT_TRUE(is_orange(at(before, 0.5, 0.5))) << "the arrow";
  EXPECT_TRUE(is_orange(at(before, 0.5, 0.73))) << "its head";
  EXPECT_FALSE(is_orange(at(before, 0.5, 0.8))) << "beyond it";
  EXPECT_FALSE(is_orange(at(before, 0.3, 0.5)));
  EXPECT_TRUE(is_orange(at(after, 0.5, 0.75)));
  EXPECT_FALSE(is_orange(at(after, 0.5, 0.5)));
  EXPECT_FALSE(is_orange(at(after, 0.5, 0.25)));
}

TEST_F(Sheets, HandlesBehindTheSurfaceAreSeen) {
  Panel panel = panel_of(sphere(1, 3));
  const Eigen::Vector3d behind(0.2, 0.1, -1);
  panel.handles = {{behind, behind, false}};
  const Image image = render({panel}, plain(400, 400));
  EXPECT_GT(count(image, {0, 0, 400, 360}, is_red), 12);
}

/// The colour bar: the longest run of ink among the rows at the bottom.
Region bar_of(const Image& image) {
  Region best;
  for (int y = image.height * 3 / 4; y < image.height; ++y) {
    const Region row = bounds(image, {0, y, image.width, y + 1}, is_ink);
    if (row.x1 - row.x0 > best.x1 - best.x0 && count(image, row, is_ink) == row.x1 - row.x0) best = row;
  }
  return best;
}

TEST_F(Sheets, AFaceHasTheColourOfTheBarAtItsValue) {
  RenderOptions options = plain(500, 400);
  options.heat_map = HeatMap{-1, 3, "of something"};
  Panel panel = panel_of(sheet(2));
  for (const double value : {-0.9, 0.1, 1.0, 2.2, 2.9}) {
    panel.face_values.setConstant(panel.mesh.triangles.rows(), value);
    const Image image = render({panel}, options);
    const Region bar = bar_of(image);
    ASSERT_GT(bar.x1 - bar.x0, 100);
    const int x = bar.x0 + static_cast<int>((value + 1) / 4 * (bar.x1 - bar.x0));
    EXPECT_LE(difference(pixel(image, 250, 150), pixel(image, x, bar.y0)), 4) << value;
  }
}

TEST_F(Sheets, ValuesBeyondTheEndsHaveTheirColoursAndNoneIsGrey) {
  RenderOptions options = plain(500, 400);
  options.heat_map = HeatMap{0, 1, ""};
  Panel panel = panel_of(sheet(1));
  const auto colour_of = [&](double value) {
    panel.face_values.setConstant(panel.mesh.triangles.rows(), value);
    return pixel(render({panel}, options), 250, 150);
  };
  EXPECT_EQ(colour_of(-5), colour_of(0));
  EXPECT_EQ(colour_of(1e300), colour_of(1));
  EXPECT_EQ(colour_of(std::numeric_limits<double>::infinity()), colour_of(1));
  EXPECT_GT(difference(colour_of(0), colour_of(1)), 100);
  const Rgb none = colour_of(std::numeric_limits<double>::quiet_NaN());
  EXPECT_LE(std::max(none[0], none[2]) - std::min(none[0], none[2]), 2);
}

double luminance(const Rgb& c) {
  const auto linear = [](int channel) { return std::pow(channel / 255.0, 2.2); };
  return 0.2126 * linear(c[0]) + 0.7152 * linear(c[1]) + 0.0722 * linear(c[2]);
}

TEST_F(Sheets, TheBarDarkensEvenly) {
  RenderOptions options = plain(1600, 400);
  options.heat_map = HeatMap{0, 1, ""};
  Panel panel = panel_of(sheet(1));
  panel.face_values.setZero(panel.mesh.triangles.rows());
  const Image image = render({panel}, options);
  const Region bar = bar_of(image);
  std::vector<double> lightness;
  for (int k = 0; k <= 10; ++k) {
    const int x = bar.x0 + (bar.x1 - 1 - bar.x0) * k / 10;
    lightness.push_back(116 * std::cbrt(luminance(pixel(image, x, bar.y0))) - 16);  // CIE 1976.
  }
  const double mean = (lightness.front() - lightness.back()) / 10;
  EXPECT_GT(mean, 6);
  for (size_t k = 1; k < lightness.size(); ++k) EXPECT_NEAR(lightness[k - 1] - lightness[k], mean, 0.35 * mean) << k;
}

TEST_F(Sheets, WordsAreWhereTheyBelong) {
  const std::vector<Panel> untitled{panel_of(sphere(1, 2)), panel_of(sphere(1, 2))};
  RenderOptions options = plain(1000, 500);
  const Image without = render(untitled, options);
  std::vector<Panel> titled = untitled;
  titled[0].title = "Vorher, größer";
  titled[1].title = "after";
  const Image with = render(titled, options);
  const Region strip{0, 0, 500, 36};
  EXPECT_GT(count(with, strip, is_dark), 40);
  const Region left = bounds(with, strip, is_ink), right = bounds(with, {500, 0, 1000, 36}, is_ink);
  EXPECT_NEAR((left.x0 + left.x1) / 2.0, 260, 10);
  EXPECT_NEAR((right.x0 + right.x1) / 2.0, 740, 10);
  EXPECT_GT(left.x1 - left.x0, 2 * (right.x1 - right.x0));
  EXPECT_EQ(count(without, {0, 0, 1000, 10}, is_ink), 0);
  options.title = "Two spheres";
  const Region title = bounds(render(untitled, options), {0, 0, 1000, 36}, is_dark);
  EXPECT_NEAR((title.x0 + title.x1) / 2.0, 500, 5);
}

TEST_F(Sheets, ALongTitleStaysInItsPanel) {
  std::vector<Panel> panels{panel_of(sphere(1, 2)), panel_of(sphere(1, 2))};
  panels[0].title = std::string(300, 'W');
  const Image image = render(panels, plain(600, 300));
  const Region title = bounds(image, {0, 0, 600, 26}, is_ink);
  EXPECT_GT(title.x1 - title.x0, 150);
  EXPECT_LT(title.x1, 300);
}

TEST_F(Sheets, ManyPanelsMakeAGrid) {
  const Panel ball = panel_of(sphere(1, 2));
  RenderOptions options = plain(600, 600);
  const std::vector<Panel> four(4, ball);
  const Image image = render(four, options);
  for (const int x : {160, 440}) {
    for (const int y : {160, 440}) EXPECT_TRUE(is_ink(pixel(image, x, y))) << x << ' ' << y;
  }
  options.columns = 4;
  const Image row = render(four, options);
  EXPECT_EQ(count(row, {0, 0, 600, 200}, is_ink), 0);
}

TEST_F(Sheets, RowsHaveScalesOfTheirOwn) {
  RenderOptions options = plain(600, 200);
  const SheetRow small{"small", {panel_of(sphere(1, 3)), panel_of(sphere(0.5, 3))}, {}};
  const SheetRow large{"large", {panel_of(sphere(10, 3))}, {}};
  const Image image = contact_sheet({small, large}, {"one", "two"}, options);
  EXPECT_EQ(image.width, 600);
  EXPECT_GT(image.height, 400);
  EXPECT_LT(image.height, 460);
  const int middle = image.height / 2 + 8;
  const auto width = [&](const Region& region) {
    const Region found = bounds(image, region, [](const Rgb& c) { return is_ink(c) && !is_dark(c) && c[2] > c[0]; });
    return found.x1 - found.x0;
  };
  EXPECT_NEAR(width({0, middle - 120, 300, middle - 40}), width({0, middle + 70, 300, middle + 160}), 2);
  EXPECT_NEAR(width({0, middle - 120, 300, middle - 40}), 2 * width({300, middle - 120, 600, middle - 40}), 3);
}

}  // namespace
}  // namespace swage::test
