// Pictures as bytes: the same ones each time, PNG files, progress, bad input, and the automatic view.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#ifdef _OPENMP
#include <omp.h>
#endif
#if __has_include(<stb/stb_image.h>)
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb/stb_image.h>
#endif

#include "picture.h"
#include "places.h"
#include "rays_embree.h"
#include "shapes.h"
#include "swage/error.h"

namespace swage::test {
namespace {

using testing::HasSubstr;

TEST(Render, DrawsOrSaysWhichOptionIsMissing) {
  try {
    EXPECT_FALSE(render({panel_of(box())}).rgb.empty());
    EXPECT_TRUE(can_render());
  } catch (const Unavailable& e) {
    EXPECT_THAT(e.what(), HasSubstr(has_embree() ? "SWAGE_RENDER" : "SWAGE_"));
  }
}

class Images : public testing::Test {
 protected:
  void SetUp() override {
    if (!can_render()) GTEST_SKIP() << "this build makes no pictures";
  }
};

/// With all there can be in it.
std::vector<Panel> panels() {
  Panel before = panel_of(torus());
  before.title = "before";
  before.handles = {{{1.4, 0, 0}, {1.4, 0, 0}, false}, {{-1.4, 0, 0}, {-1.8, 0.3, 0.2}, false}};
  Panel after = before;
  after.caption = "after";
  after.face_values = after.mesh.positions(after.mesh.triangles.col(0), 0);
  return {before, after};
}

RenderOptions small() {
  RenderOptions options;
  options.width = 500;
  options.height = 300;
  return options;
}

TEST_F(Images, AreTheSameFromAnyNumberOfThreads) {
  const Image once = render(panels(), small());
  EXPECT_EQ(render(panels(), small()).rgb, once.rgb);
#ifdef _OPENMP
  const int threads = omp_get_max_threads();
  for (const int n : {1, 2, 3}) {
    omp_set_num_threads(n);
    EXPECT_EQ(render(panels(), small()).rgb, once.rgb) << n;
  }
  omp_set_num_threads(threads);
#endif
}

#if __has_include(<stb/stb_image.h>)
TEST_F(Images, ComeBackFromAPngFile) {
  const TempFolder folder;
  const Image image = render(panels(), small());
  write_png(folder / "picture.png", image);
  const std::string bytes = read_text(folder / "picture.png");
  EXPECT_EQ(bytes, png(image));
  int width = 0, height = 0, channels = 0;
  unsigned char* read = stbi_load_from_memory(reinterpret_cast<const unsigned char*>(bytes.data()),
                                              static_cast<int>(bytes.size()), &width, &height, &channels, 0);
  ASSERT_NE(read, nullptr);
  EXPECT_EQ(width, image.width);
  EXPECT_EQ(height, image.height);
  EXPECT_EQ(channels, 3);
  EXPECT_TRUE(std::equal(image.rgb.begin(), image.rgb.end(), read));
  stbi_image_free(read);
}
#endif

TEST_F(Images, ThatCannotBeWrittenSaySo) {
  const TempFolder folder;
  const Image image{64, 1, std::vector<unsigned char>(192, 7)};
  EXPECT_THROW(write_png(folder / "missing/picture.png", image), UnwritableFile);
  EXPECT_THROW(png({}), InvalidInput);
  EXPECT_THROW(png({64, 2, image.rgb}), InvalidInput);
  EXPECT_THROW(png({-64, -1, image.rgb}), InvalidInput);
}

TEST_F(Images, TellProgressAndStop) {
  std::vector<double> fractions;
  render(panels(), small(), [&](const Progress& now) {
    fractions.push_back(now.fraction);
    return true;
  });
  EXPECT_GT(fractions.size(), 4U);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_GE(fractions.front(), 0);
  EXPECT_DOUBLE_EQ(fractions.back(), 1);
  for (size_t stop = 1; stop <= fractions.size(); ++stop) {
    size_t asked = 0;
    const Image image = render(panels(), small(), [&](const Progress&) { return ++asked < stop; });
    EXPECT_TRUE(image.rgb.empty());
    EXPECT_EQ(image.width, 0);
    EXPECT_EQ(asked, stop) << "it stops at once";
  }
}

TEST_F(Images, OfWhatCannotBeDrawnAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto expect_refused = [](const std::string& says, const std::function<void(Panel&, RenderOptions&)>& spoil) {
    Panel panel = panel_of(box());
    RenderOptions options = small();
    spoil(panel, options);
    for (const bool sheet : {false, true}) {
      try {
        sheet ? contact_sheet({{"", {panel}, {}}}, {}, options) : render({panel}, options);
        ADD_FAILURE() << says;
      } catch (const InvalidInput& e) {
        EXPECT_THAT(e.what(), HasSubstr(says));
        EXPECT_THAT(e.what(), HasSubstr(sheet ? "contact_sheet" : "render"));
      }
    }
  };
  expect_refused("width", [](Panel&, RenderOptions& o) { o.width = 63; });
  expect_refused("width", [](Panel&, RenderOptions& o) { o.width = 16385; });
  expect_refused("height", [](Panel&, RenderOptions& o) { o.height = -1; });
  expect_refused("supersampling", [](Panel&, RenderOptions& o) { o.supersampling = 0; });
  expect_refused("ambient_rays", [](Panel&, RenderOptions& o) { o.ambient_rays = 65; });
  expect_refused("columns", [](Panel&, RenderOptions& o) { o.columns = -1; });
  expect_refused("feature_angle", [&](Panel&, RenderOptions& o) { o.feature_angle = nan; });
  expect_refused("heat_map", [](Panel&, RenderOptions& o) { o.heat_map = HeatMap{1, 1, ""}; });
  expect_refused("heat_map", [&](Panel&, RenderOptions& o) { o.heat_map = HeatMap{0, nan, ""}; });
  expect_refused("view", [](Panel&, RenderOptions& o) { o.view = View{{0, 0, 0}, {0, 1, 0}}; });
  expect_refused("view", [&](Panel&, RenderOptions& o) { o.view = View{{0, 0, nan}, {0, 1, 0}}; });
  expect_refused("up", [](Panel&, RenderOptions& o) { o.up.setZero(); });
  expect_refused("face_values", [](Panel& p, RenderOptions&) { p.face_values.setZero(5); });
  expect_refused("vertex 3", [&](Panel& p, RenderOptions&) { p.mesh.positions(3, 1) = nan; });
  expect_refused("no triangles", [](Panel& p, RenderOptions&) { p.mesh.triangles.resize(0, 3); });
  expect_refused("one place", [](Panel& p, RenderOptions&) { p.mesh.positions.setOnes(); });
  expect_refused("handle 0", [&](Panel& p, RenderOptions&) { p.handles = {{{0, 0, 0}, {0, nan, 0}, false}}; });
  EXPECT_THROW(render({}, small()), InvalidInput);
  EXPECT_THROW(contact_sheet({}, {}, small()), InvalidInput);
  EXPECT_THROW(contact_sheet({{"", {}, {}}}, {}, small()), InvalidInput);
  EXPECT_THROW(contact_sheet({{"", {panel_of(box())}, {}}}, {"one", "too many"}, small()), InvalidInput);
}

TEST_F(Images, OfMeshesThatAreBarelyOnes) {
  Panel collapsed = panel_of(box());
  collapsed.mesh.positions.setZero();
  const Image image = render({panel_of(box()), collapsed}, plain(600, 300));
  EXPECT_GT(count(image, {0, 0, 300, 300}, is_ink), 1000);
  EXPECT_EQ(count(image, {300, 0, 600, 300}, is_ink), 0);
  Panel line = panel_of(box());
  line.mesh.positions.rightCols(2).setZero();
  EXPECT_EQ(render({line}, plain(300, 300)).width, 300);
  Panel far = panel_of(transformed(box(), 1e-3, {1e6, -1e6, 1e6}));
  const Image seen = render({far}, plain(300, 300));
  EXPECT_GT(count(seen, all_of(seen), is_ink), 20000);
}

TEST_F(Images, FromStraightAboveHaveAnUp) {
  const Image image = render({panel_of(box({2, 1, 1}))}, plain(400, 400, {0, 1, 0}));
  const Region seen = bounds(image, all_of(image), is_ink);
  const double ratio = double(seen.x1 - seen.x0) / (seen.y1 - seen.y0);
  EXPECT_NEAR(std::max(ratio, 1 / ratio), 2, 0.02);
}

TEST_F(Images, AutomaticViewsShowMostAndArrowsFromTheSide) {
  const Mesh mesh = box();
  const View view = automatic_view(mesh);
  EXPECT_GT(view.from.y(), 0) << "from above";
  EXPECT_GT(view.from.z(), 0) << "from the front";
  EXPECT_NEAR(view.from.norm(), 1, 1e-9);
  EXPECT_GT(automatic_view(mesh, {}, {0, 0, 1}).from.z(), 0);
  for (const double turn : {30.0, -30.0, 55.0, -55.0}) {
    const double angle = turn * std::numbers::pi / 180;
    const Eigen::Vector3d along(std::sin(angle), 0, std::cos(angle)), corner(1, 1, 1);
    const Eigen::Vector3d from = automatic_view(mesh, {{corner, corner + along, false}}).from;
    EXPECT_LT(std::abs(from.dot(along)), 0.75) << turn;
  }
  EXPECT_THROW(automatic_view(mesh, {}, {0, 0, 0}), InvalidInput);
  EXPECT_THROW(automatic_view({}), InvalidInput);
}

}  // namespace
}  // namespace swage::test
