#include "flat.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "measures.h"
#include "shapes.h"

namespace swage {
namespace {

/// Two triangles that meet along a side which one of them halves: the gap has no area.
TEST(LentNormals, AreTheNeighboursOfFlatTriangles) {
  Mesh mesh{Positions(5, 3), Triangles(3, 3)};
  mesh.positions << 0, 0, 0, 1, 0, 0, 0.5, 0, 0, 0.5, 1, 0, 0.5, -1, 0;
  mesh.triangles << 0, 1, 3, 0, 2, 1, 2, 0, 4;
  const std::vector<char> is_flat = flat_triangles(mesh.positions, mesh.triangles);
  EXPECT_EQ(is_flat, (std::vector<char>{0, 1, 0}));
  const Positions normals = lent_normals(mesh.positions, mesh.triangles, edges_of(mesh.triangles), is_flat);
  EXPECT_NEAR(normals(1, 2), 1, 1e-12);
  EXPECT_LT((normals.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-12);
}

TEST(LentNormals, OfTrianglesThatHaveAreaAreTheirs) {
  const Mesh mesh = test::sphere(1, 2);
  const std::vector<char> is_flat = flat_triangles(mesh.positions, mesh.triangles);
  EXPECT_EQ(std::count(is_flat.begin(), is_flat.end(), 1), 0);
  EXPECT_EQ(lent_normals(mesh.positions, mesh.triangles, edges_of(mesh.triangles), is_flat),
            unit_normals(mesh.positions, mesh.triangles));
}

TEST(LentNormals, WithoutAnyNeighbourStandOnTheLongestSide) {
  Mesh mesh{Positions(3, 3), Triangles(1, 3)};
  mesh.positions << 0, 0, 0, 1, 1, 1, 2, 2, 2;
  mesh.triangles << 0, 1, 2;
  const Positions normals = lent_normals(mesh.positions, mesh.triangles, edges_of(mesh.triangles), {1});
  EXPECT_NEAR(normals.row(0).norm(), 1, 1e-12);
  EXPECT_NEAR(normals.row(0).sum(), 0, 1e-12);
}

}  // namespace
}  // namespace swage
