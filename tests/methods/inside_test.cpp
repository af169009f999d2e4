// Which tetrahedra are within a surface, told by the volume that they fill.
#include "inside.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "shapes.h"
#include "swage/scaffold.h"

namespace swage::test {
namespace {

double filled(const Mesh& mesh) {
  ScaffoldOptions options;
  options.leave_out_crossing = true;
  const Scaffold all = scaffold(mesh.positions, mesh.triangles, options);
  const std::vector<char> inside = are_inside(mesh, all.positions, all.tetrahedra, {});
  double sum = 0;
  for (Eigen::Index t = 0; t < all.tetrahedra.rows(); ++t) {
    if (inside[static_cast<size_t>(t)] == 0) continue;
    const auto corner = [&](int k) -> Eigen::Vector3d { return all.positions.row(all.tetrahedra(t, k)); };
    sum += (corner(1) - corner(0)).cross(corner(2) - corner(0)).dot(corner(3) - corner(0)) / 6;
  }
  return sum;
}

TEST(AreInside, FillClosedSurfacesWhicheverWayTheyWind) {
  const Mesh ring = torus(1, 0.4, 24, 12), block = box({1, 2, 0.5}, 4);
  EXPECT_NEAR(filled(ring), volume(ring), 1e-9);
  EXPECT_NEAR(filled(block), 1, 1e-9);
  const Mesh turned{ring.positions, ring.triangles.rowwise().reverse()};
  EXPECT_NEAR(filled(turned), volume(ring), 1e-9);
  EXPECT_NEAR(filled(joined(turned, transformed(block, 1, {3, 0, 0}))), volume(ring) + 1, 1e-9);
}

/// A ball within a ball counts once.
TEST(AreInside, CountWhatSeveralComponentsEncloseOnce) {
  const Mesh ball = sphere(1, 2);
  EXPECT_NEAR(filled(joined(ball, sphere(0.5, 2))), volume(ball), 1e-9);
}

/// Triangles that cross are no faces of the filling, which then follows the surface as nearly as they are small.
TEST(AreInside, FillComponentsThatCross) {
  const Mesh block = box({1, 1, 1}, 12), both = joined(block, transformed(block, 1, {0.53, 0.31, 0.17}));
  const double expected = 2 - 0.47 * 0.69 * 0.83;
  EXPECT_NEAR(filled(both), expected, 0.05);
}

TEST(AreInside, FindNothingWithinAnOpenSheet) { EXPECT_EQ(filled(sheet(6)), 0); }

}  // namespace
}  // namespace swage::test
