#include "nearest.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "shapes.h"

namespace swage {
namespace {

Eigen::Vector3d point_of(const Mesh& mesh, const Foot& foot) {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    point += foot.barycentric[k] * mesh.positions.row(mesh.triangles(foot.triangle, k)).transpose();
  }
  return point;
}

TEST(TriangleTree, FindsTheNearestPointOfASphere) {
  const Mesh mesh = test::sphere(2, 4);
  const TriangleTree tree(mesh.positions, mesh.triangles);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d direction = Eigen::Vector3d::Random().normalized();
    for (const double radius : {0.5, 1.9, 3.0, 50.0}) {
      const Foot foot = tree.nearest(radius * direction);
      EXPECT_NEAR(foot.distance, std::abs(radius - 2), 0.01) << radius;
      EXPECT_NEAR((point_of(mesh, foot) - radius * direction).norm(), foot.distance, 1e-12);
      EXPECT_NEAR(foot.barycentric.sum(), 1, 1e-12);
      EXPECT_GE(foot.barycentric.minCoeff(), 0);
    }
  }
}

TEST(TriangleTree, IsAsGoodAsLookingAtAllTriangles) {
  Mesh mesh{Positions::Random(90, 3), Triangles(30, 3)};
  for (int t = 0; t < 30; ++t) mesh.triangles.row(t) << 3 * t, 3 * t + 1, 3 * t + 2;
  const TriangleTree tree(mesh.positions, mesh.triangles);
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d point = 2 * Eigen::Vector3d::Random();
    double least = 1e9;
    for (int t = 1; t < 30; t += 2) {
      least = std::min(least, nearest_on_triangle(point, mesh.positions.row(3 * t), mesh.positions.row(3 * t + 1),
                                                  mesh.positions.row(3 * t + 2))
                                  .distance);
    }
    const Foot foot = tree.nearest(point, 1e9, [](int t) { return t % 2 == 1; });
    EXPECT_EQ(foot.triangle % 2, 1);
    EXPECT_DOUBLE_EQ(foot.distance, least);
    EXPECT_LT(tree.nearest(point, 0.5 * least, [](int t) { return t % 2 == 1; }).triangle, 0);
  }
}

TEST(NearestOnTriangle, NoFinerPointOfItIsNearer) {
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d a = Eigen::Vector3d::Random(), b = Eigen::Vector3d::Random(), c = Eigen::Vector3d::Random();
    const Eigen::Vector3d p = 2 * Eigen::Vector3d::Random();
    const double found = nearest_on_triangle(p, a, b, c).distance;
    double sampled = 1e9;
    for (int u = 0; u <= 60; ++u) {
      for (int v = 0; u + v <= 60; ++v) {
        const Eigen::Vector3d q = a + u / 60.0 * (b - a) + v / 60.0 * (c - a);
        sampled = std::min(sampled, (p - q).norm());
      }
    }
    EXPECT_LE(found, sampled + 1e-12);
    EXPECT_GE(found, sampled - 0.05);
  }
}

TEST(NearestOnTriangle, WithoutAreaIsThatOfItsSides) {
  const Eigen::Vector3d a(0, 0, 0), b(2, 0, 0), c(1, 0, 0);
  const Foot foot = nearest_on_triangle({1.5, 3, 0}, a, b, c);
  EXPECT_DOUBLE_EQ(foot.distance, 3);
  EXPECT_DOUBLE_EQ(foot.barycentric.sum(), 1);
  EXPECT_DOUBLE_EQ(nearest_on_triangle({1, 1, 0}, a, a, a).distance, std::sqrt(2.0));
}

TEST(TriangleTree, VisitsTheTrianglesWhoseBoxesMeet) {
  const Mesh mesh = test::sheet(4);
  const TriangleTree tree(mesh.positions, mesh.triangles);
  std::vector<int> met;
  tree.near({Eigen::Vector3d(0.1, 0.1, -1), Eigen::Vector3d(0.2, 0.2, 1)}, [&](int t) { met.push_back(t); });
  std::sort(met.begin(), met.end());
  EXPECT_EQ(met, (std::vector<int>{0, 1}));
}

}  // namespace
}  // namespace swage
