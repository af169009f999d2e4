// Points and surfaces given otherwise, by any number of threads, cancelled, and refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>
#ifdef _OPENMP
#include <omp.h>
#endif

#include "points_near.h"
#include "rays_embree.h"
#include "shapes.h"
#include "swage/error.h"
#include "swage/transfer.h"

namespace swage {
namespace {

using testing::HasSubstr;

class AttachInput : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_embree()) GTEST_SKIP() << "this build has no Embree";
  }
};

Attachments attached(const Positions& points, const Mesh& mesh, const TransferOptions& options = {}) {
  return attach(points, mesh.positions, mesh.triangles, options);
}

TEST_F(AttachInput, TakesColumnMajorMatrices) {
  const Mesh mesh = test::torus();
  const Eigen::MatrixXd points = test::points_near(mesh, 300, 1), positions = mesh.positions;
  const Eigen::MatrixXi triangles = mesh.triangles;
  const Attachments by_column = attach(points, positions, triangles), by_row = attached(points, mesh);
  EXPECT_EQ(by_column.triangles, by_row.triangles);
  EXPECT_EQ(by_column.barycentric, by_row.barycentric);
  EXPECT_EQ(by_column.offsets, by_row.offsets);
}

#ifdef _OPENMP
TEST_F(AttachInput, IsTheSameBytesForAnyNumberOfThreads) {
  const Mesh mesh = test::bumpy_sphere(4);
  const Positions points = test::points_near(mesh, 20000, 1);
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const Attachments one = attached(points, mesh);
  for (const int count : {2, 5}) {
    omp_set_num_threads(count);
    const Attachments several = attached(points, mesh);
    EXPECT_EQ(several.triangles, one.triangles) << count << " threads";
    EXPECT_EQ(several.barycentric, one.barycentric) << count << " threads";
    EXPECT_EQ(several.offsets, one.offsets) << count << " threads";
  }
  omp_set_num_threads(threads);
}
#endif

TEST_F(AttachInput, TellsItsProgressAndCanBeCancelled) {
  const Mesh mesh = test::sphere(1, 2);
  const Positions points = test::points_near(mesh, 50000, 1);
  std::vector<double> fractions;
  const auto watch = [&](const Progress& progress) {
    EXPECT_STREQ(progress.stage, "attach");
    fractions.push_back(progress.fraction);
    return true;
  };
  EXPECT_EQ(attach(points, mesh.positions, mesh.triangles, {}, watch).triangles.size(), 50000);
  EXPECT_GT(fractions.size(), 3u);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_EQ(fractions.front(), 0);
  EXPECT_EQ(fractions.back(), 1);
  for (const size_t allowed : {0u, 1u, 2u}) {
    size_t asked = 0;
    const Attachments none =
        attach(points, mesh.positions, mesh.triangles, {}, [&](const Progress&) { return asked++ < allowed; });
    EXPECT_EQ(asked, allowed + 1);
    EXPECT_EQ(none.triangles.size(), 0);
    EXPECT_EQ(none.offsets.rows(), 0);
  }
}

template <typename Call>
std::string refusal(const Call& call) {
  try {
    call();
  } catch (const InvalidInput& e) {
    return e.what();
  }
  return "";
}

TEST(AttachRefusal, NamesArgumentAndRow) {
  Mesh mesh = test::sheet();
  Positions points = Positions::Random(9, 3);
  EXPECT_THAT(refusal([&] { attached(Positions(0, 3), mesh); }), HasSubstr("points"));
  EXPECT_THAT(refusal([&] { attached(points, {Positions(0, 3), mesh.triangles}); }), HasSubstr("positions"));
  EXPECT_THAT(refusal([&] { attached(points, {mesh.positions, Triangles(0, 3)}); }), HasSubstr("triangles"));
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), -2e12}) {
    points(7, 1) = bad;
    EXPECT_THAT(refusal([&] { attached(points, mesh); }), HasSubstr("points: row 7"));
  }
  points(7, 1) = 0;
  EXPECT_THAT(refusal([&] { attached(points, mesh, {.directions = -1}); }), HasSubstr("options.directions"));
  EXPECT_THAT(refusal([&] { attached(points, mesh, {.directions = 10001}); }), HasSubstr("options.directions"));
  EXPECT_THAT(refusal([&] { attached(points, mesh, {.detour = 0.5}); }), HasSubstr("options.detour"));
  EXPECT_THAT(refusal([&] { attached(points, mesh, {.detour = std::nan("")}); }), HasSubstr("options.detour"));
  EXPECT_THAT(refusal([&] { attached(points, mesh, {.normals = Positions::Zero(8, 3)}); }),
              HasSubstr("options.normals: 8 rows"));
  Positions normals = Positions::Random(9, 3);
  normals(4, 0) = std::nan("");
  EXPECT_THAT(refusal([&] { attached(points, mesh, {.normals = normals}); }), HasSubstr("options.normals: row 4"));
  mesh.positions(3, 2) = std::nan("");
  EXPECT_THAT(refusal([&] { attached(points, mesh); }), HasSubstr("vertex 3"));
}

}  // namespace
}  // namespace swage
