#include "swage/features.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <random>

#include "adjacency.h"
#include "measures.h"
#include "shapes.h"
#include "swage/error.h"

namespace swage {
namespace {

using test::kDegree;

FeatureEdges features(const Mesh& mesh, double degrees = 160) {
  return feature_edges(mesh.positions, mesh.triangles, degrees * kDegree);
}

bool has(const FeatureEdges& edges, int a, int b) {
  for (const auto& edge : edges.rowwise()) {
    if (edge[0] == a && edge[1] == b) return true;
  }
  return false;
}

/// Two triangles at the edge 0-1 with this angle between them.
Mesh roof(double degrees) {
  Mesh mesh{Positions(4, 3), Triangles(2, 3)};
  mesh.positions << 0, 0, 0, 1, 0, 0, 0.3, 1, 0, 0.6, std::cos(degrees * kDegree), std::sin(degrees * kDegree);
  mesh.triangles << 0, 1, 2, 1, 0, 3;
  return mesh;
}

TEST(FeatureEdges, AreThoseOfABox) {
  const FeatureEdges edges = features(test::box({1, 2, 3}, 5));
  EXPECT_EQ(edges.rows(), 12 * 5);
  const Positions at = test::box({1, 2, 3}, 5).positions;
  for (const auto& edge : edges.rowwise()) {
    const Eigen::Array3d middle = (at.row(edge[0]) + at.row(edge[1])).array() / 2 / Eigen::RowVector3d(1, 2, 3).array();
    EXPECT_EQ((middle.abs() < 1e-12 || (middle - 1).abs() < 1e-12).count(), 2);
  }
}

TEST(FeatureEdges, AreNoneOnASmoothSurface) { EXPECT_EQ(features(test::sphere(1, 3)).rows(), 0); }

TEST(FeatureEdges, AreBelowTheAngleOnly) {
  for (const double angle : {0.0, 1.0, 60.0, 90.0, 120.0, 179.0}) {
    EXPECT_TRUE(has(features(roof(angle), angle + 1e-3), 0, 1)) << angle;
    EXPECT_FALSE(has(features(roof(angle), angle), 0, 1)) << angle;
    EXPECT_FALSE(has(features(roof(angle), std::max(angle - 1e-3, 0.0)), 0, 1)) << angle;
  }
}

TEST(FeatureEdges, AreThoseThatNormalsTell) {
  Mesh mesh = test::sphere(1, 3);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> noise(0.9, 1.1);
  for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v) mesh.positions.row(v) *= noise(random);
  const Edges all = edges_of(mesh.triangles);
  const Positions normals = unit_normals(mesh.positions, mesh.triangles);
  const FeatureEdges found = features(mesh, 140);
  Eigen::Index f = 0;
  for (int e = 0; e < all.vertices.rows(); ++e) {
    const Lists::Range beside = all.triangles[e];
    if (dihedral_angle(normals.row(beside[0]), normals.row(beside[1])) >= 140 * kDegree) continue;
    ASSERT_LT(f, found.rows());
    EXPECT_EQ(found.row(f++), all.vertices.row(e));
  }
  EXPECT_EQ(f, found.rows());
  EXPECT_GT(f, 100);
  EXPECT_LT(f, all.vertices.rows() - 100);
}

TEST(FeatureEdges, DoNotDependOnHowTrianglesWindNorOnTheirOrder) {
  Mesh mesh = test::cylinder();
  const FeatureEdges edges = features(mesh);
  std::mt19937 random(3);
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    if (random() % 2 == 0) std::swap(mesh.triangles(t, 0), mesh.triangles(t, 2));
    mesh.triangles.row(t).swap(mesh.triangles.row(static_cast<Eigen::Index>(random()) % (t + 1)));
  }
  EXPECT_EQ(features(mesh), edges);
}

TEST(FeatureEdges, AreWhereASurfaceEnds) { EXPECT_EQ(features(test::sheet(6), 0).rows(), 4 * 6); }

TEST(FeatureEdges, AreWhereThreeTrianglesMeet) {
  Mesh mesh = roof(180);
  EXPECT_FALSE(has(features(mesh), 0, 1));
  mesh.positions.conservativeResize(5, 3);
  mesh.positions.row(4) << 0.5, 0, 1;
  mesh.triangles.conservativeResize(3, 3);
  mesh.triangles.row(2) << 0, 1, 4;
  EXPECT_TRUE(has(features(mesh, 0), 0, 1));
}

TEST(FeatureEdges, ATriangleRepeatedCountsOnce) {
  Mesh mesh = roof(180);
  const FeatureEdges once = features(mesh);
  mesh.triangles.conservativeResize(4, 3);
  mesh.triangles.bottomRows(2) << 2, 0, 1, 1, 0, 2;
  EXPECT_EQ(features(mesh), once);
}

/// A roof whose edge 0-1 is split at 4 on one side: a triangle without area closes the gap.
Mesh split_roof(double degrees) {
  Mesh mesh = roof(degrees);
  mesh.positions.conservativeResize(5, 3);
  mesh.positions.row(4) << 0.4, 0, 0;
  mesh.triangles.resize(4, 3);
  mesh.triangles << 0, 1, 2, 4, 0, 3, 1, 4, 3, 0, 4, 1;
  return mesh;
}

TEST(FeatureEdges, AreSeenAcrossTrianglesWithoutArea) {
  const FeatureEdges flat = features(split_roof(180)), sharp = features(split_roof(90));
  for (const auto& [a, b] : {std::pair(0, 1), {0, 4}, {1, 4}}) {
    EXPECT_FALSE(has(flat, a, b)) << a << "-" << b;
    EXPECT_TRUE(has(sharp, a, b)) << a << "-" << b;
  }
  EXPECT_FALSE(has(sharp, 3, 4));
}

TEST(FeatureEdges, AreSeenAcrossANeedleWhoseEndIsOnePoint) {
  // Vertex 0 twice, as 0 and 4, with a triangle between.
  Mesh mesh = roof(180);
  mesh.positions.conservativeResize(5, 3);
  mesh.positions.row(4) = mesh.positions.row(0);
  mesh.triangles.resize(3, 3);
  mesh.triangles << 0, 1, 2, 1, 4, 3, 0, 4, 1;
  const FeatureEdges flat = features(mesh);
  EXPECT_FALSE(has(flat, 0, 1));
  EXPECT_FALSE(has(flat, 1, 4));
  EXPECT_FALSE(has(flat, 0, 4)) << "without length";
  mesh.positions.row(3) = roof(90).positions.row(3);
  EXPECT_TRUE(has(features(mesh), 0, 1));
  EXPECT_TRUE(has(features(mesh), 1, 4));
}

TEST(FeatureEdges, TrianglesWithAVertexTwiceAreNotThere) {
  Mesh mesh = roof(180);
  const FeatureEdges without = features(mesh);
  mesh.triangles.conservativeResize(4, 3);
  mesh.triangles.bottomRows(2) << 0, 1, 1, 3, 3, 3;
  EXPECT_EQ(features(mesh), without);
  mesh.triangles = mesh.triangles.bottomRows(2).eval();
  EXPECT_EQ(features(mesh).rows(), 0);
}

TEST(FeatureEdges, AreNoneWhereAllVerticesAreAtOnePoint) {
  Mesh mesh = roof(90);
  mesh.positions.setOnes();
  EXPECT_EQ(features(mesh).rows(), 0);
}

TEST(FeatureEdges, TakeAnAngle) {
  for (const double degrees : {-1.0, 180.1, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THAT([&] { features(roof(90), degrees); },
                testing::ThrowsMessage<InvalidInput>(testing::HasSubstr("feature_edges: feature_angle")));
  }
  EXPECT_NO_THROW(features(roof(90), 0));
  EXPECT_NO_THROW(features(roof(90), 180));
  Mesh mesh = roof(90);
  mesh.triangles(1, 2) = 4;
  EXPECT_THROW(features(mesh), InvalidInput);
}

}  // namespace
}  // namespace swage
