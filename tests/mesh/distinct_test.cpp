#include "distinct.h"

#include <gtest/gtest.h>

#include "shapes.h"

namespace swage {
namespace {

TEST(Distinct, LeavesAMeshOfDistinctTrianglesAsItIs) {
  const Mesh mesh = test::torus();
  const Distinct surface = distinct(mesh.positions, mesh.triangles);
  EXPECT_EQ(surface.triangles, mesh.triangles);
  EXPECT_EQ(surface.vertices.size(), static_cast<size_t>(mesh.positions.rows()));
  EXPECT_EQ(surface.vertices.back(), mesh.positions.rows() - 1);
  EXPECT_EQ(surface.originals.size(), static_cast<size_t>(mesh.triangles.rows()));
}

TEST(Distinct, MergesPlacesAndDropsTheSecondOfAKind) {
  Positions positions(7, 3);
  positions << 9, 9, 9, 0, 0, 0, 1, 0, 0, 0, 1, 0, -0.0, 0, 0, 1, 0, 0, 0, 0, 1;
  const Triangles triangles{{1, 2, 3}, {3, 5, 4}, {1, 4, 6}, {4, 2, 6}, {2, 2, 3}};
  const Distinct surface = distinct(positions, triangles);
  EXPECT_EQ(surface.vertices, (std::vector<int>{1, 2, 3, 6}));
  EXPECT_EQ(surface.triangles, (Triangles{{0, 1, 2}, {0, 1, 3}}));
  EXPECT_EQ(surface.originals, (std::vector<int>{0, 3}));
  EXPECT_EQ(first_at_place(positions), (std::vector<int>{0, 1, 2, 3, 1, 2, 6}));
}

TEST(Distinct, KeepsFlatTrianglesWhereAskedTo) {
  const Positions positions{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 0, 0}};
  const Triangles triangles{{0, 1, 2}, {0, 1, 3}, {0, 4, 3}, {2, 1, 4}};
  EXPECT_EQ(distinct(positions, triangles).originals, std::vector<int>{1});
  EXPECT_EQ(distinct(positions, triangles, FlatTriangles::kept).originals, (std::vector<int>{0, 1}));
}

TEST(Distinct, DropsTrianglesWithoutAreaWhateverTheirSize) {
  for (const double size : {1e-100, 1.0, 1e9}) {
    Positions positions(5, 3);
    positions << 0, 0, 0, 1, 0, 0, 0.5, 1e-11, 0, 0.5, 1e-9, 0, 2, 0, 0;
    const Triangles triangles{{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
    EXPECT_EQ(distinct(size * positions, triangles).originals, std::vector<int>{1}) << size;
  }
  EXPECT_TRUE(distinct(Positions::Zero(3, 3), Triangles{{0, 1, 2}}).originals.empty());
}

}  // namespace
}  // namespace swage
