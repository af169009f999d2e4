#include "adjacency.h"

#include <gtest/gtest.h>

#include <set>

#include "shapes.h"

namespace swage {
namespace {

TEST(Edges, OfAClosedSurfaceHaveTwoTrianglesAndEulersCount) {
  for (const auto& [mesh, euler] : {std::pair{test::sphere(1, 2), 2},
                                    {test::torus(1, 0.4, 8, 6), 0},
                                    {test::box({1, 1, 1}, 3), 2},
                                    {test::cylinder(1, 1, 16, 4), 2}}) {
    const Edges edges = edges_of(mesh.triangles);
    for (int e = 0; e < edges.triangles.size(); ++e) EXPECT_EQ(edges.triangles[e].size(), 2);
    EXPECT_EQ(mesh.positions.rows() - edges.vertices.rows() + mesh.triangles.rows(), euler);
  }
}

TEST(Edges, NameTheCornersTheyJoin) {
  const Mesh mesh = test::sheet(3);
  const Edges edges = edges_of(mesh.triangles);
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const std::set<int> corners{mesh.triangles(t, k), mesh.triangles(t, (k + 1) % 3)};
      const int e = edges.triangle_edges(t, k);
      EXPECT_EQ(corners, (std::set<int>{edges.vertices(e, 0), edges.vertices(e, 1)}));
      EXPECT_LT(edges.vertices(e, 0), edges.vertices(e, 1));
    }
  }
}

TEST(Edges, KeepEveryTriangleOfANonManifoldEdge) {
  Triangles fan(3, 3);
  fan << 0, 1, 2, 1, 0, 3, 0, 1, 4;
  const Edges edges = edges_of(fan);
  EXPECT_EQ(edges.vertices.row(0), Eigen::RowVector2i(0, 1));
  EXPECT_EQ(std::vector<int>(edges.triangles[0].begin(), edges.triangles[0].end()), (std::vector<int>{0, 1, 2}));
}

TEST(OneRings, AreNeighboursAscending) {
  const Mesh mesh = test::sheet(2);
  const Lists rings = one_rings(edges_of(mesh.triangles), static_cast<int>(mesh.positions.rows()));
  EXPECT_EQ(std::vector<int>(rings[4].begin(), rings[4].end()), (std::vector<int>{0, 1, 3, 5, 7, 8}));
}

TEST(Components, AreNumberedByFirstVertexAndCountLoneVertices) {
  Triangles triangles(2, 3);
  triangles << 5, 6, 4, 1, 3, 2;
  EXPECT_EQ(components(triangles, 8), (std::vector<int>{0, 1, 1, 1, 2, 2, 2, 3}));
}

}  // namespace
}  // namespace swage
