#include "rays_embree.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "shapes.h"
#include "swage/error.h"

namespace swage {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
const Eigen::Vector3d kUp(0, 0, 1), kDown(0, 0, -1);

TEST(RaysOff, SayWhichOptionIsMissing) {
  if (has_embree()) GTEST_SKIP() << "this build has Embree";
  const Mesh mesh = test::sheet();
  try {
    RayScene(mesh.positions, mesh.triangles);
    FAIL();
  } catch (const Unavailable& e) {
    EXPECT_NE(std::string(e.what()).find("SWAGE_EMBREE"), std::string::npos);
  }
}

class Rays : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_embree()) GTEST_SKIP() << "this build has no Embree";
  }
};

/// Two sheets of a pair of triangles, at heights 0 (0 and 1) and 0.25 (2 and 3).
Mesh two_sheets() {
  const Mesh sheet = test::sheet(1);
  return test::joined(sheet, test::transformed(sheet, 1, {0, 0, 0.25}));
}

TEST_F(Rays, MeetTheFirstTriangleFromEitherSide) {
  const Mesh mesh = two_sheets();
  const RayScene scene(mesh.positions, mesh.triangles);
  const std::set<int> low{0, 1}, high{2, 3};
  EXPECT_TRUE(low.contains(scene.first_hit({0.3, 0.4, -1}, kUp, kFar)));
  EXPECT_TRUE(low.contains(scene.first_hit({0.3, 0.4, 0.1}, kDown, kFar)));
  EXPECT_TRUE(high.contains(scene.first_hit({0.3, 0.4, 0.1}, kUp, kFar)));
  EXPECT_TRUE(high.contains(scene.first_hit({0.3, 0.4, 2}, kDown, kFar)));
  EXPECT_EQ(scene.first_hit({0.3, 0.4, 2}, kUp, kFar), -1);
  EXPECT_EQ(scene.first_hit({1.3, 0.4, 2}, kDown, kFar), -1);
}

TEST_F(Rays, EndAtTheirReach) {
  const Mesh mesh = two_sheets();
  const RayScene scene(mesh.positions, mesh.triangles);
  EXPECT_EQ(scene.first_hit({0.3, 0.4, 1.25}, kDown, 0.999), -1);
  EXPECT_GE(scene.first_hit({0.3, 0.4, 1.25}, kDown, 1), 2);
}

TEST_F(Rays, FromAPointOfTheSurfaceMeetIt) {
  const Mesh mesh = test::sphere(0.5, 3);
  const RayScene scene(mesh.positions, mesh.triangles);
  for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v) {
    const Eigen::Vector3d at = mesh.positions.row(v), out = at.normalized();
    EXPECT_GE(scene.first_hit(at, out, 0), 0) << v;
    EXPECT_GE(scene.first_hit(at, -out, 0), 0) << v;
  }
}

TEST_F(Rays, PassThroughWhatDoesNotCount) {
  const Mesh mesh = two_sheets();
  const RayScene scene(mesh.positions, mesh.triangles);
  const int hit = scene.first_hit({0.3, 0.4, 2}, kDown, kFar, [](int triangle) { return triangle < 2; });
  EXPECT_TRUE(hit == 0 || hit == 1);
  EXPECT_EQ(scene.first_hit({0.3, 0.4, 2}, kDown, kFar, [](int) { return false; }), -1);
}

TEST_F(Rays, TellWhereTheyMeetTheSurface) {
  const Mesh mesh = test::sphere(0.5, 3);
  const RayScene scene(mesh.positions, mesh.triangles);
  std::vector<Ray> rays;
  for (int i = 0; i < 100; ++i) {
    const auto offset = 0.007F + 0.013F * static_cast<float>(i);  // Not at a vertex.
    rays.push_back({{offset, 0.5F * offset, 2}, kDown.cast<float>(), 10});
  }
  const std::vector<RayHit> hits = scene.first_hits(rays);
  ASSERT_EQ(hits.size(), rays.size());
  int met = 0;
  for (size_t i = 0; i < rays.size(); ++i) {
    EXPECT_EQ(hits[i].triangle, scene.first_hit(rays[i].origin.cast<double>(), kDown, 10)) << i;
    if (hits[i].triangle < 0) continue;
    ++met;
    const auto corner = [&](int k) -> Eigen::RowVector3f {
      return mesh.positions.row(mesh.triangles(hits[i].triangle, k)).cast<float>();
    };
    const float u = hits[i].u, v = hits[i].v;
    const Eigen::RowVector3f by_weights = (1 - u - v) * corner(0) + u * corner(1) + v * corner(2);
    const Eigen::RowVector3f along = (rays[i].origin + hits[i].distance * rays[i].direction).transpose();
    EXPECT_LT((by_weights - along).norm(), 1e-5F) << i;
  }
  EXPECT_GT(met, 25);
  EXPECT_LT(met, 40);  // 0.5 / sqrt(1.25) / 0.013 = 34.4.
}

TEST_F(Rays, AreOccludedWithinTheirReach) {
  const Mesh mesh = two_sheets();
  const RayScene scene(mesh.positions, mesh.triangles);
  const Eigen::Vector3f down = kDown.cast<float>(), up = kUp.cast<float>();
  const std::vector<Ray> rays{{{0.3F, 0.4F, 1.25F}, down, 0.99F}, {{0.3F, 0.4F, 1.25F}, down, 1.01F},
                              {{0.3F, 0.4F, 0.1F}, up, 0.14F},    {{0.3F, 0.4F, 0.1F}, up, 0.16F},
                              {{0.3F, 0.4F, 0.3F}, up, 9},        {{1.3F, 0.4F, 2}, down, 9}};
  EXPECT_EQ(scene.occluded(rays), (std::vector<char>{0, 1, 0, 1, 0, 0}));
  EXPECT_TRUE(scene.occluded({}).empty());
  EXPECT_TRUE(scene.first_hits({}).empty());
}

TEST_F(Rays, NoTriangleWithinReachIsPassedBy) {
  const Mesh mesh = test::sphere(0.5, 3);
  const RayScene scene(mesh.positions, mesh.triangles);
  const Eigen::Vector3d point(0.3, 0.2, 0.1);
  for (const double reach : {0.0, 0.2, 0.4, 2.0}) {
    std::set<int> visited;
    scene.visit_near(point, reach, [&](int triangle) {
      visited.insert(triangle);
      return reach;
    });
    for (int t = 0; t < mesh.triangles.rows(); ++t) {
      const auto corners = mesh.positions(mesh.triangles.row(t), Eigen::all);
      const double nearest = (corners.rowwise() - point.transpose()).rowwise().norm().minCoeff();
      if (nearest <= reach) {
        EXPECT_TRUE(visited.contains(t)) << t << " within " << reach;
      }
    }
    if (reach < 0.05) {
      EXPECT_LT(visited.size(), 100u);
    }
  }
}

TEST_F(Rays, ASmallerReachEndsTheVisitsSooner) {
  const Mesh mesh = test::sphere(0.5, 5);
  const RayScene scene(mesh.positions, mesh.triangles);
  int visits = 0;
  scene.visit_near({0.7, 0, 0}, kFar, [&](int triangle) {
    ++visits;
    return (mesh.positions.row(mesh.triangles(triangle, 0)) - Eigen::RowVector3d(0.7, 0, 0)).norm();
  });
  EXPECT_GT(visits, 0);
  EXPECT_LT(visits, mesh.triangles.rows() / 10);
}

}  // namespace
}  // namespace swage
