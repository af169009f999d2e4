// What cannot be a scaffold is a message, and the process lives on.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "shapes.h"
#include "swage/error.h"
#include "swage/scaffold.h"
#include "tetrahedra.h"

namespace swage {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class FailingScaffold : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_tetgen()) GTEST_SKIP() << "built without TetGen";
  }
};

template <typename Error>
std::string message_of(const Mesh& mesh, const ScaffoldOptions& options = {}) {
  try {
    scaffold(mesh.positions, mesh.triangles, options);
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

TEST_F(FailingScaffold, CrossingTrianglesAreNamed) {
  const Mesh sphere = test::sphere(1, 2);
  const Mesh mesh = test::joined(sphere, test::transformed(sphere, 1, {1, 0.01, 0.02}));
  EXPECT_THAT(message_of<Unsolvable>(mesh),
              AllOf(HasSubstr("scaffold: triangles "), HasSubstr(" more cross or overlap others")));

  Mesh pierced = test::box({1, 1, 1}, 1);  // Triangle 12 through one of the sides, vertices 8 to 10.
  pierced.positions.conservativeResize(11, 3);
  pierced.positions.bottomRows(3) << 0.3, 0.2, -0.5, 0.3, 0.2, 0.5, 0.35, 0.25, -0.5;
  pierced.triangles.conservativeResize(13, 3);
  pierced.triangles.row(12) << 8, 9, 10;
  EXPECT_THAT(message_of<Unsolvable>(pierced), testing::ContainsRegex("triangles [0-9]+, 12 cross"));
  EXPECT_GT(scaffold(sphere.positions, sphere.triangles).tetrahedra.rows(), 0);
}

TEST_F(FailingScaffold, CrossingTrianglesCanBeLeftOut) {
  const Mesh sphere = test::sphere(1, 2);
  const Mesh mesh = test::joined(sphere, test::transformed(sphere, 1, {1, 0.01, 0.02}));
  const Scaffold s = scaffold(mesh.positions, mesh.triangles, {.leave_out_crossing = true});
  EXPECT_EQ(s.positions.topRows(mesh.positions.rows()), mesh.positions);
  // Those along the circle where the spheres meet, and none far from it.
  EXPECT_GT(s.left_out.size(), 20u);
  for (int t : s.left_out) {
    const Eigen::RowVector3d middle = mesh.positions(mesh.triangles.row(t), Eigen::all).colwise().mean();
    EXPECT_NEAR(middle.x(), 0.5, 0.35) << t;
  }
  std::set<int> corners(s.tetrahedra.data(), s.tetrahedra.data() + s.tetrahedra.size());
  for (int v = 0; v < mesh.positions.rows(); ++v) EXPECT_TRUE(corners.contains(v)) << v;
  EXPECT_TRUE(scaffold(sphere.positions, sphere.triangles, {.leave_out_crossing = true}).left_out.empty());
}

TEST_F(FailingScaffold, AHeapOfCrossingTrianglesIsAMessage) {
  Mesh heap{Positions(120, 3), Triangles(40, 3)};
  for (int v = 0; v < 120; ++v) heap.positions.row(v) << std::sin(7.1 * v), std::sin(3.3 * v * v), std::cos(5.7 * v);
  for (int t = 0; t < 40; ++t) heap.triangles.row(t) << 3 * t, 3 * t + 1, 3 * t + 2;
  EXPECT_THAT(message_of<Unsolvable>(heap, {.time_limit = 20}), HasSubstr("scaffold: "));
}

TEST_F(FailingScaffold, EndsAtTheTimeLimit) {
  const Mesh mesh = test::sphere(1, 6);
  EXPECT_THAT(message_of<Unsolvable>(mesh, {.time_limit = 0.05}), HasSubstr("swage-tetgen did not end within"));
}

TEST_F(FailingScaffold, IsCancelled) {
  const Mesh mesh = test::sphere(1, 6);
  int asked = 0;
  const Scaffold none = scaffold(mesh.positions, mesh.triangles, {}, [&](const Progress& progress) {
    EXPECT_STREQ(progress.stage, "scaffold");
    return ++asked < 2;
  });
  EXPECT_EQ(asked, 2);
  EXPECT_EQ(none.positions.rows(), 0);
  EXPECT_EQ(none.tetrahedra.rows(), 0);
}

TEST(ScaffoldInput, RefusesBadInput) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Mesh mesh = test::sheet(2);
  EXPECT_THAT(message_of<InvalidInput>(mesh, {.enlargement = 1}), HasSubstr("enlargement"));
  EXPECT_THAT(message_of<InvalidInput>(mesh, {.enlargement = nan}), HasSubstr("enlargement"));
  EXPECT_THAT(message_of<InvalidInput>(mesh, {.time_limit = 0}), HasSubstr("time_limit"));
  EXPECT_THAT(message_of<InvalidInput>({Positions::Zero(3, 3), Triangles{{0, 1, 2}}}), HasSubstr("none has an area"));
  mesh.triangles(1, 2) = 9;
  EXPECT_THAT(message_of<InvalidInput>(mesh), HasSubstr("triangle 1"));
  mesh = test::sheet(2);
  mesh.positions(4, 1) = nan;
  EXPECT_THAT(message_of<InvalidInput>(mesh), HasSubstr("vertex 4"));
}

TEST(ScaffoldInput, NamesTheOptionWhereTetGenIsLeftOut) {
  if (has_tetgen()) GTEST_SKIP() << "built with TetGen";
  EXPECT_THAT(message_of<Unavailable>(test::sheet(2)), HasSubstr("SWAGE_TETGEN"));
}

}  // namespace
}  // namespace swage
