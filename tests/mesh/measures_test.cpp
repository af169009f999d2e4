#include "measures.h"

#include <gtest/gtest.h>

#include <numbers>

#include "shapes.h"
#include "swage/error.h"

namespace swage {
namespace {

TEST(Measures, NormalsPointOutwards) {
  for (const Mesh& mesh : {test::sphere(2, 2), test::cylinder(1, 2), test::box({1, 2, 3}, 3)}) {
    const Eigen::RowVector3d middle = mesh.positions.colwise().mean();
    const Positions normals = unit_normals(mesh.positions, mesh.triangles);
    for (Eigen::Index t = 0; t < normals.rows(); ++t) {
      EXPECT_NEAR(normals.row(t).norm(), 1, 1e-14);
      EXPECT_GT(normals.row(t).dot(mesh.positions.row(mesh.triangles(t, 0)) - middle), 0);
    }
  }
}

TEST(Measures, AreaOfASphere) {
  const Mesh mesh = test::sphere(2, 5);
  EXPECT_NEAR(area_vectors(mesh.positions, mesh.triangles).rowwise().norm().sum() / 2, 16 * std::numbers::pi, 0.05);
}

TEST(Measures, MeanEdgeLengthCountsInteriorEdgesTwice) {
  Positions positions(4, 3);
  positions << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
  Triangles triangles(2, 3);
  triangles << 0, 1, 2, 0, 2, 3;
  EXPECT_NEAR(mean_edge_length(positions, triangles), (4 + 2 * std::sqrt(2.0)) / 6, 1e-15);
}

TEST(Measures, ATriangleHasAreaDownToAHeightOf1e10OfItsLongestSide) {
  const auto of_height = [](double height, double size) {
    Positions positions(3, 3);
    positions << 0, 0, 0, 2, 0, 0, 0.3, height, 0;
    return has_area(size * positions, {0, 1, 2});
  };
  for (const double size : {1e-9, 1.0, 1e9}) {
    EXPECT_TRUE(of_height(3e-10, size));
    EXPECT_FALSE(of_height(1e-10, size));
    EXPECT_FALSE(of_height(0, size));
  }
  EXPECT_FALSE(has_area(Positions::Random(2, 3), {0, 1, 1}));
}

TEST(Measures, DihedralAngle) {
  const Eigen::Vector3d up(0, 0, 1);
  EXPECT_EQ(dihedral_angle(up, up), std::numbers::pi);
  EXPECT_NEAR(dihedral_angle(up, {1, 0, 0}), std::numbers::pi / 2, 1e-15);
  const double small = 1e-9;
  EXPECT_NEAR(std::numbers::pi - dihedral_angle(up, {std::sin(small), 0, std::cos(small)}), small, 1e-15);
}

TEST(Measures, UnitBoxGoesThereAndBack) {
  const Mesh mesh = test::transformed(test::box({1, 2, 4}, 2), 3, {5, -7, 9});
  const UnitBox box = unit_box(mesh.positions);
  const Positions inside = box.into(mesh.positions);
  EXPECT_EQ(inside.colwise().minCoeff(), Eigen::RowVector3d(0, 0, 0));
  EXPECT_TRUE(inside.colwise().maxCoeff().isApprox(Eigen::RowVector3d(0.25, 0.5, 1)));
  EXPECT_TRUE(box.back(inside).isApprox(mesh.positions, 1e-15));
  EXPECT_THROW(unit_box(Positions::Ones(3, 3)), InvalidInput);
}

}  // namespace
}  // namespace swage
