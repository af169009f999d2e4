// Which cells the triangles of a model touch, one triangle after the other.
#include "coverage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "clipped.h"
#include "shapes.h"

namespace swage::test {
namespace {

using Eigen::Index;

GridShape grid_of(const Mesh& mesh, int x, int y, int z) {
  const Eigen::RowVector3d low = mesh.positions.colwise().minCoeff(), high = mesh.positions.colwise().maxCoeff();
  return {{{x, y, z}}, low, high - low};
}

TEST(Coverage, OfAModelIsThatOfItsTriangles) {
  const auto mesh = std::make_shared<Mesh>(joined(torus(1, 0.4, 12, 8), box({0.3, 2, 0.1}, 1)));
  const GridShape shape = grid_of(*mesh, 9, 11, 5);
  Index due = 0;
  each_coverage(shape, mesh, *cpu_backend(), {}, [&](Index t, std::span<const int> cells) {
    EXPECT_EQ(t, due++);
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.row(k) = mesh->positions.row(mesh->triangles(t, k));
    EXPECT_EQ(std::vector<int>(cells.begin(), cells.end()), cells_by_clipping(shape, corners, 1e-10L)) << t;
  });
  EXPECT_EQ(due, mesh->triangles.rows());
}

TEST(Coverage, OfManyTrianglesComesInTheirOrder) {
  const auto mesh = std::make_shared<Mesh>(sheet(600));  // More than are asked for at once.
  const GridShape shape = grid_of(*mesh, 7, 5, 1);
  Index due = 0;
  each_coverage(shape, mesh, *cpu_backend(), {}, [&](Index t, std::span<const int> cells) {
    ASSERT_EQ(t, due++);
    ASSERT_GE(cells.size(), 1);
    const Eigen::RowVector3d corner = mesh->positions.row(mesh->triangles(t, 0));
    const auto at = [&](double x, int count) { return std::min(static_cast<int>(x * count), count - 1); };
    ASSERT_TRUE(std::ranges::count(cells, static_cast<int>(shape.cells.at(at(corner[0], 7), at(corner[1], 5), 0))));
  });
  EXPECT_EQ(due, mesh->triangles.rows());
}

TEST(Coverage, OfLargeTrianglesInManyCellsComesInParts) {
  // Forty thousand cells each and more: at once they would be three million.
  const int count = 60;
  const auto mesh = std::make_shared<Mesh>(Mesh{Positions(3, 3), Triangles(count, 3)});
  mesh->positions << 0, 0, 0.1, 1, 0, 0.9, 0, 1, 0.8;
  for (auto t : mesh->triangles.rowwise()) t << 0, 1, 2;
  const GridShape shape = {{{215, 215, 215}}, {0, 0, 0}, {1, 1, 1}};
  std::vector<int> first;
  int asked = 0;
  Index due = 0;
  each_coverage(
      shape, mesh, *cpu_backend(), [&] { ++asked; },
      [&](Index t, std::span<const int> cells) {
        ASSERT_EQ(t, due++);
        if (t == 0) first.assign(cells.begin(), cells.end());
        ASSERT_TRUE(std::ranges::equal(cells, first));
      });
  EXPECT_EQ(due, count);
  EXPECT_GT(first.size(), 40'000);
  EXPECT_GT(asked, 2);
  EXPECT_THROW(each_coverage(
                   shape, mesh, *cpu_backend(), [] { throw Cancelled(); }, [](Index, std::span<const int>) {}),
               Cancelled);
}

TEST(Coverage, OfNoTrianglesIsNone) {
  const auto mesh = std::make_shared<Mesh>(Mesh{Positions(0, 3), Triangles(0, 3)});
  each_coverage({{{2, 2, 2}}, {0, 0, 0}, {1, 1, 1}}, mesh, *cpu_backend(), {},
                [](Index, std::span<const int>) { FAIL(); });
}

}  // namespace
}  // namespace swage::test
