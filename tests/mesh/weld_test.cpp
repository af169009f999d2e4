#include "weld.h"

#include <gtest/gtest.h>

#include "shapes.h"

namespace swage {
namespace {

TEST(Weld, JoinsPlacesAndDropsRepeats) {
  Mesh mesh{Positions(7, 3), Triangles(5, 3)};
  mesh.positions << 9, 9, 9, 0, 0, 0, 1, 0, 0, 0, 1, 0, -0.0, 0, 0, 1, 0, 0, 2, 0, 0;
  mesh.triangles << 1, 2, 3, 4, 5, 3, 3, 2, 1, 1, 4, 3, 4, 5, 6;
  const Mesh result = welded(mesh.positions, mesh.triangles);
  EXPECT_EQ(result.positions, (Positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}}));
  EXPECT_EQ(result.triangles, (Triangles{{0, 1, 2}, {0, 1, 3}}));  // The flat one stays.
}

TEST(Weld, LeavesAWeldedMesh) {
  const Mesh box = test::box();
  const Mesh result = welded(box.positions, box.triangles);
  EXPECT_EQ(result.positions, box.positions);
  EXPECT_EQ(result.triangles, box.triangles);
}

}  // namespace
}  // namespace swage
