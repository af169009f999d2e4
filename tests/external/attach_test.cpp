// Where points hang on a surface, against brute force.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "foot_search.h"
#include "measures.h"
#include "points_near.h"
#include "shapes.h"
#include "swage/transfer.h"

namespace swage {
namespace {

using Eigen::RowVector3d;
using Eigen::Vector3d;

class Attach : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_embree()) GTEST_SKIP() << "this build has no Embree";
  }
};

Attachments attached(const Positions& points, const Mesh& mesh, const TransferOptions& options = {}) {
  return attach(points, mesh.positions, mesh.triangles, options);
}

/// By the regions in which a corner, a side or the inside is closest.
Vector3d closest_point(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d ab = b - a, ac = c - a, bc = c - b;
  const double ab_a = ab.dot(p - a), ac_a = ac.dot(p - a), ab_b = ab.dot(p - b);
  const double ac_b = ac.dot(p - b), ab_c = ab.dot(p - c), ac_c = ac.dot(p - c);
  if (ab_a <= 0 && ac_a <= 0) return a;
  if (ab_b >= 0 && ac_b <= ab_b) return b;
  if (ac_c >= 0 && ab_c <= ac_c) return c;
  const double beside_ab = ab_a * ac_b - ab_b * ac_a, beside_ac = ab_c * ac_a - ab_a * ac_c;
  const double beside_bc = ab_b * ac_c - ab_c * ac_b;
  if (beside_ab <= 0 && ab_a >= 0 && ab_b <= 0) return a + ab_a / (ab_a - ab_b) * ab;
  if (beside_ac <= 0 && ac_a >= 0 && ac_c <= 0) return a + ac_a / (ac_a - ac_c) * ac;
  if (beside_bc <= 0) return b + (ac_b - ab_b) / ((ac_b - ab_b) + (ab_c - ac_c)) * bc;
  return a + (beside_ac * ab + beside_ab * ac) / (beside_ab + beside_ac + beside_bc);
}

double closest_distance(const Vector3d& point, const Mesh& mesh) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh.triangles.rowwise()) {
    const Vector3d foot =
        closest_point(point, mesh.positions.row(t[0]), mesh.positions.row(t[1]), mesh.positions.row(t[2]));
    least = std::min(least, (foot - point).norm());
  }
  return least;
}

Positions feet(const Attachments& attachments, const Mesh& mesh) {
  Positions result = Positions::Zero(attachments.triangles.size(), 3);
  for (Eigen::Index i = 0; i < result.rows(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const int v = mesh.triangles(attachments.triangles[i], k);
      result.row(i) += attachments.barycentric(i, k) * mesh.positions.row(v);
    }
  }
  return result;
}

/// Triangles that are there, coordinates within them, offsets from there to the points.
void expect_sound(const Attachments& attachments, const Positions& points, const Mesh& mesh) {
  ASSERT_EQ(attachments.triangles.size(), points.rows());
  ASSERT_GE(attachments.triangles.minCoeff(), 0);
  ASSERT_LT(attachments.triangles.maxCoeff(), mesh.triangles.rows());
  EXPECT_GE(attachments.barycentric.minCoeff(), 0);
  EXPECT_LT((attachments.barycentric.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-15);
  const double largest = std::max(points.cwiseAbs().maxCoeff(), mesh.positions.cwiseAbs().maxCoeff());
  EXPECT_LT((feet(attachments, mesh) + attachments.offsets - points).cwiseAbs().maxCoeff(), 1e-14 * largest);
}

/// How many of the feet are not the closest, to `tolerance`. None may be closer.
int farther_than_closest(const Attachments& attachments, const Positions& points, const Mesh& mesh,
                         double tolerance = 1e-12) {
  int count = 0;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const double due = closest_distance(points.row(i), mesh), found = attachments.offsets.row(i).norm();
    EXPECT_GT(found, due - tolerance);
    count += found > due + tolerance;
  }
  return count;
}

TEST_F(Attach, FeetAreTheClosestPoints) {
  for (const Mesh& mesh : {test::bumpy_sphere(3), test::torus(), test::box({2, 1, 0.3}, 6), test::cylinder()}) {
    const Positions points = test::points_near(mesh, 1000, 3);
    for (const int directions : {0, 3, 16, 100}) {
      const Attachments attachments = attached(points, mesh, {.directions = directions});
      expect_sound(attachments, points, mesh);
      EXPECT_EQ(farther_than_closest(attachments, points, mesh), 0);
    }
  }
}

TEST_F(Attach, PointsOfTheSurfaceAreTheirFeet) {
  for (const Mesh& mesh : {test::bumpy_sphere(3), test::box({2, 1, 0.3}, 5), test::sheet(7)}) {
    const Attachments corners = attached(mesh.positions, mesh);
    EXPECT_TRUE(corners.offsets.isZero(0));
    EXPECT_EQ(corners.barycentric.rowwise().maxCoeff().minCoeff(), 1);
    const Mesh finer = test::subdivided(mesh);  // Old vertices and middles of sides.
    EXPECT_LT(attached(finer.positions, mesh).offsets.cwiseAbs().maxCoeff(), 1e-15);
    Positions centres(mesh.triangles.rows(), 3);
    for (Eigen::Index t = 0; t < centres.rows(); ++t) {
      centres.row(t) = mesh.positions(mesh.triangles.row(t), Eigen::all).colwise().mean();
    }
    const Attachments inside = attached(centres, mesh);
    EXPECT_LT(inside.offsets.cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_EQ(inside.triangles, Eigen::VectorXi::LinSpaced(centres.rows(), 0, static_cast<int>(centres.rows()) - 1));
  }
}

TEST_F(Attach, AnOpenSheetIsFoundEdgeOnAndFromTheSide) {
  const Mesh sheet = test::sheet(6);
  Positions points(6, 3), due(6, 3);
  points << 1.5, 0.3, 0, -2, -2, 0, 0.31, 0.42, 0.2, 0.31, 0.42, -3, 1.2, 0.5, 1e-9, 40, 0.5, 1e-3;
  due << 1, 0.3, 0, 0, 0, 0, 0.31, 0.42, 0, 0.31, 0.42, 0, 1, 0.5, 0, 1, 0.5, 0;
  for (const int directions : {0, 1, 16}) {
    const Attachments attachments = attached(points, sheet, {.directions = directions});
    expect_sound(attachments, points, sheet);
    EXPECT_LT((feet(attachments, sheet) - due).cwiseAbs().maxCoeff(), 1e-13) << directions;
  }
}

TEST_F(Attach, FarPointsFindTheSideThatFacesThem) {
  const Mesh mesh = test::bumpy_sphere(2);
  const double height = mesh.positions.col(1).maxCoeff();
  for (const double distance : {30.0, 900.0, 1e5, 1e12}) {
    for (const int directions : {0, 16}) {
      const Positions points = RowVector3d(0, distance, 0);
      const Attachments attachments = attached(points, mesh, {.directions = directions});
      expect_sound(attachments, points, mesh);
      EXPECT_GT(feet(attachments, mesh)(0, 1), height - 0.01) << distance;
    }
  }
}

TEST_F(Attach, FeetOfPointsWithinAClosedSurfaceAreTheClosest) {
  const Mesh mesh = test::bumpy_sphere(3);
  const Positions points = 0.6 * Positions::Random(300, 3);
  EXPECT_EQ(farther_than_closest(attached(points, mesh), points, mesh), 0);
}

TEST_F(Attach, TrianglesWithoutAreaDoNoHarm) {
  Mesh mesh{Positions(6, 3), Triangles(5, 3)};
  mesh.positions << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0.5, 0, 0, 3, 0, 0, 3, 0, 0;
  mesh.triangles << 0, 3, 1, 0, 0, 2, 0, 1, 2, 1, 1, 1, 4, 1, 5;
  const Positions points = 2 * Positions::Random(500, 3);
  for (const int directions : {0, 16}) {
    const Attachments attachments = attached(points, mesh, {.directions = directions});
    expect_sound(attachments, points, mesh);
    EXPECT_EQ(farther_than_closest(attachments, points, mesh), 0);
  }
  for (const Mesh& none : {Mesh{Positions::Ones(3, 3), RowVector3d(0, 1, 2).cast<int>()},
                           Mesh{mesh.positions, mesh.triangles.bottomRows(2)}}) {
    const Attachments attachments = attached(points, none);
    expect_sound(attachments, points, none);
    EXPECT_EQ(farther_than_closest(attachments, points, none), 0);
  }
}

TEST_F(Attach, ASoupIsAsGoodAsASurface) {
  const Mesh mesh = test::bumpy_sphere(4), loose = test::soup(mesh);
  const Positions points = test::points_near(mesh, 2000, 1);
  const Attachments on_mesh = attached(points, mesh), on_soup = attached(points, loose, {.directions = 0});
  EXPECT_EQ(on_soup.triangles, on_mesh.triangles);
  EXPECT_EQ(on_soup.offsets, on_mesh.offsets);
}

TEST_F(Attach, OfTrianglesAsNearTheLowestIsTaken) {
  const Mesh box = test::box({1, 1, 1}, 3);
  const Mesh twice{box.positions, test::joined(box, box).triangles.unaryExpr(
                                      [&](int v) { return v % static_cast<int>(box.positions.rows()); })};
  const Lists around = triangles_of_vertices(box.triangles, static_cast<int>(box.positions.rows()));
  for (const int directions : {0, 16}) {
    const Attachments attachments = attached(box.positions, twice, {.directions = directions});
    for (int v = 0; v < box.positions.rows(); ++v) EXPECT_EQ(attachments.triangles[v], around[v][0]);
  }
}

TEST_F(Attach, NormalsKeepAThinPlatesSidesApart) {
  const Mesh plate = test::box({1, 1, 0.01}, 8);
  // Both faces' points lie beyond the middle of the plate.
  Positions points(2, 3), normals(2, 3);
  points << 0.41, 0.37, 0.002, 0.41, 0.37, 0.008;
  normals << 0, 0, 0.5, 0, 0, -2;
  for (const int directions : {0, 16}) {
    const TransferOptions facing{directions, normals};
    EXPECT_NEAR(feet(attached(points, plate, facing), plate)(0, 2), 0.01, 1e-15);
    EXPECT_NEAR(feet(attached(points, plate, facing), plate)(1, 2), 0, 1e-15);
    for (const TransferOptions& blind :
         {TransferOptions{directions}, TransferOptions{directions, Positions::Zero(2, 3)},
          TransferOptions{directions, normals, 3.9}}) {
      EXPECT_NEAR(feet(attached(points, plate, blind), plate)(0, 2), 0, 1e-15);
      EXPECT_NEAR(feet(attached(points, plate, blind), plate)(1, 2), 0.01, 1e-15);
    }
  }
}

TEST_F(Attach, ASmallSurfaceFarFromTheOriginLosesOnlyWhatItsCoordinatesDo) {
  const Mesh near = test::bumpy_sphere(3);
  const Positions points = test::points_near(near, 500, 1);
  const Mesh far = test::transformed(near, 1, {1e6, -1e6, 1e6});
  const Positions far_points = points.rowwise() + RowVector3d(1e6, -1e6, 1e6);
  const Attachments attachments = attached(far_points, far);
  expect_sound(attachments, far_points, far);
  EXPECT_LT((attachments.offsets - attached(points, near).offsets).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_EQ(farther_than_closest(attachments, far_points, far, 1e-9), 0);
}

TEST_F(Attach, AVertexThatNoTriangleNamesDoesNotCount) {
  Mesh mesh = test::sphere(1, 3);
  const Positions points = test::points_near(mesh, 200, 1);
  const Attachments without = attached(points, mesh);
  mesh.positions.conservativeResize(mesh.positions.rows() + 1, 3);
  mesh.positions.bottomRows(1) << 1e11, 0, 0;
  EXPECT_EQ(attached(points, mesh).offsets, without.offsets);
}

TEST_F(Attach, NeedlesOfAFanAreToldApart) {
  const int sides = 3000;
  Mesh fan{Positions(sides + 1, 3), Triangles(sides, 3)};
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    fan.positions.row(i) << std::cos(angle), std::sin(angle), 0;
    fan.triangles.row(i) << sides, i, (i + 1) % sides;
  }
  fan.positions.row(sides).setZero();
  const Positions points = Positions::Random(2000, 3);
  const Attachments attachments = attached(points, fan);
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const double beyond = std::max(0., points.row(i).head<2>().norm() - 1);
    EXPECT_NEAR(attachments.offsets.row(i).norm(), std::hypot(beyond, points(i, 2)), 1e-6);
    if (beyond > 0) continue;
    const double turn = std::atan2(points(i, 1), points(i, 0)) / (2 * std::numbers::pi);
    EXPECT_EQ(attachments.triangles[i], static_cast<int>((turn < 0 ? turn + 1 : turn) * sides));
  }
}

TEST(SphereDirections, AreEven) {
  EXPECT_TRUE(sphere_directions(0).empty());
  for (const int count : {1, 2, 16, 64, 500}) {
    const std::vector<Vector3d> directions = sphere_directions(count);
    ASSERT_EQ(directions.size(), static_cast<size_t>(count));
    for (const Vector3d& direction : directions) EXPECT_NEAR(direction.norm(), 1, 1e-15);
    // Caps about them that cover the sphere are not much larger than their share of it.
    double widest = 0;
    for (const Vector3d& towards : sphere_directions(5000)) {
      double nearest = 4;
      for (const Vector3d& direction : directions) nearest = std::min(nearest, (direction - towards).norm());
      widest = std::max(widest, nearest);
    }
    if (count > 2) {
      EXPECT_LT(widest * widest / 4, 2.5 / count) << count;
    }
  }
}

}  // namespace
}  // namespace swage
