// Painted spheres as styles.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "refused.h"
#include "shapes.h"
#include "sphere.h"
#include "swage/error.h"
#include "swage/style_io.h"
#include "swage/stylize.h"

namespace swage::test {
namespace {

using Eigen::Vector3d;
using enum CaptureLayout;

using std::numbers::pi;

/// Where normal(column, row) gives each pixel's, their middles at halves.
template <typename Normal>
NormalPicture painted(int width, int height, const Normal& normal) {
  NormalPicture picture{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Vector3d n = normal(x + 0.5, y + 0.5);
      for (int k = 0; k < 3; ++k) picture.normals.push_back(static_cast<float>(n[k]));
    }
  }
  return picture;
}

/// Each point of the sphere painted with itself: rows are angles from y, columns turn from z by x.
Vector3d on_globe(double x, double y, double height) {
  const double down = pi * y / height, around = 2 * pi * (x / (2 * height) - 0.5);
  return {std::sin(down) * std::sin(around), std::cos(down), std::sin(down) * std::cos(around)};
}

NormalPicture globe(int height) {
  return painted(2 * height, height, [&](double x, double y) { return on_globe(x, y, height); });
}

/// As seen from z on the left, from -z on the right; zero beyond the discs.
NormalPicture discs(int height) {
  return painted(2 * height, height, [&](double x, double y) -> Vector3d {
    const bool left = x < height;
    const double a = 2 * (left ? x : x - height) / height - 1, b = 1 - 2 * y / height;
    if (a * a + b * b > 1) return Vector3d::Zero();
    const double c = std::sqrt(1 - a * a - b * b);
    return left ? Vector3d(a, b, c) : Vector3d(-a, b, -c);
  });
}

Positions seen(const SphereMap& map, const Positions& directions) { return on_sphere(map, directions, *cpu_backend()); }

/// Degrees, the largest between what the capture says of directions and what is expected.
template <typename Expected>
double farthest_from(const SphereMap& map, const Expected& expected) {
  const Positions directions = sphere(1, 4).positions;
  const Positions normals = seen(map, directions);
  double most = 0;
  for (Eigen::Index i = 0; i < normals.rows(); ++i) {
    const Vector3d due = expected(Vector3d(directions.row(i).transpose()));
    most = std::max(most, std::acos(std::clamp(due.dot(normals.row(i).transpose()), -1.0, 1.0)));
  }
  return most * 180 / pi;
}

Vector3d itself(const Vector3d& direction) { return direction; }

Vector3d seen_at(const SphereMap& map, const Vector3d& direction) {
  return seen(map, Positions(direction.transpose())).row(0).transpose();
}

TEST(NormalCapture, OfEachPointItselfIsTheIdentity) {
  EXPECT_LT(farthest_from(normal_capture(globe(256), equirectangular), itself), 0.5);
  EXPECT_LT(farthest_from(normal_capture(discs(256), hemispheres), itself), 1);
}

TEST(NormalCapture, FewPixelsDoToo) {
  EXPECT_LT(farthest_from(normal_capture(globe(16), equirectangular), itself), 10);
  EXPECT_LT(farthest_from(normal_capture(discs(16), hemispheres), itself), 10);
}

TEST(NormalCapture, HasItsAxesWhereTheLayoutSays) {
  const Vector3d a(0.6, 0.8, 0), b(0, 0.6, 0.8), c(0.8, 0, 0.6), d(-0.6, 0, 0.8);
  // Quarters of the globe around z, x, -z and -x; and the topmost sixth.
  const SphereMap map = normal_capture(painted(128, 64,
                                               [&](double x, double y) -> Vector3d {
                                                 if (y < 64.0 / 6) return Vector3d::UnitX();
                                                 if (std::abs(x - 64) < 16) return a;
                                                 if (std::abs(x - 96) < 16) return b;
                                                 return std::abs(x - 32) < 16 ? d : c;
                                               }),
                                       equirectangular);
  EXPECT_LT((seen_at(map, Vector3d::UnitY()) - Vector3d::UnitX()).norm(), 1e-6);
  EXPECT_LT((seen_at(map, Vector3d::UnitZ()) - a).norm(), 1e-6);
  EXPECT_LT((seen_at(map, Vector3d::UnitX()) - b).norm(), 1e-6);
  EXPECT_LT((seen_at(map, -Vector3d::UnitZ()) - c).norm(), 1e-6);
  EXPECT_LT((seen_at(map, -Vector3d::UnitX()) - d).norm(), 1e-6);
}

TEST(NormalCapture, SmallGapsAreFilledFromAround) {
  NormalPicture picture = globe(128);
  const auto hole = [&](double share) {
    NormalPicture result = picture;
    for (int y = 0; y < 128; ++y) {
      for (int x = 0; x < 256; ++x) {
        if (on_globe(x + 0.5, y + 0.5, 128).x() < 1 - 2 * share) continue;
        for (int k = 0; k < 3; ++k) result.normals[static_cast<size_t>(3 * (256 * y + x) + k)] = 0;
      }
    }
    return result;
  };
  // 3 % of the sphere is a cap 20 degrees wide from its middle.
  EXPECT_LT(farthest_from(normal_capture(hole(0.03), equirectangular), itself), 21);
  expect_refused([&] { normal_capture(hole(0.2), equirectangular); }, "of the sphere has no normal, around (1, 0, 0)");
  expect_refused([&] { normal_capture(discs(64), equirectangular); }, "has no normal");
}

/// Half way between opposite normals there is none, and around there they cancel.
TEST(NormalCapture, GapsBetweenOppositeNormalsAreFilled) {
  const NormalPicture picture = painted(8, 4, [](double x, double y) -> Vector3d {
    return {0, 0, x == 3.5 && y == 0.5 ? -1.0 : 1.0};
  });
  const SphereMap map = normal_capture(picture, equirectangular);
  EXPECT_NEAR((map.normals.rowwise().norm().array() - 1).abs().maxCoeff(), 0, 1e-12);
}

TEST(NormalCapture, OtherPicturesAreRefused) {
  const auto one = [](double, double) { return Vector3d(0, 0, 1); };
  expect_refused([&] { normal_capture(painted(64, 64, one), equirectangular); }, "twice as wide as high");
  expect_refused([&] { normal_capture(painted(64, 64, one), hemispheres); }, "64 x 64 pixels; in the layout hemi");
  expect_refused([&] { normal_capture(painted(4, 2, one), equirectangular); }, "rows");
  expect_refused([&] { normal_capture(NormalPicture{4, 2, {1, 2, 3}}, equirectangular); }, "no normals of 4 x 2");
  expect_refused([&] { normal_capture(NormalPicture{}, equirectangular); }, "no normals of 0 x 0");
}

TEST(NormalCapture, OfAMeshIsWhatItIsPaintedWith) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.8, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Mesh ball = sphere(1, 4);
  const Mesh painted_ball = transformed(ball, 7, {30, -20, 10});
  const SphereMap map = normal_capture(painted_ball, 3 * ball.positions * turn.transpose());
  EXPECT_LT(farthest_from(map, [&](const Vector3d& d) { return Vector3d(turn * d); }), 0.1);
}

/// A globe by latitude and longitude whose seam is open and whose poles have triangles without area.
Mesh open_globe(int rows) {
  Mesh mesh{Positions((rows + 1) * (2 * rows + 1), 3), Triangles(4 * rows * rows, 3)};
  const auto vertex = [&](int x, int y) { return y * (2 * rows + 1) + x; };
  for (int y = 0; y <= rows; ++y) {
    for (int x = 0; x <= 2 * rows; ++x) mesh.positions.row(vertex(x, y)) = on_globe(x, y, rows).transpose();
  }
  int t = 0;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < 2 * rows; ++x) {
      mesh.triangles.row(t++) << vertex(x, y), vertex(x, y + 1), vertex(x + 1, y + 1);
      mesh.triangles.row(t++) << vertex(x, y), vertex(x + 1, y + 1), vertex(x + 1, y);
    }
  }
  for (const int pole : {0, rows}) {
    for (int x = 0; x <= 2 * rows; ++x) mesh.positions.row(vertex(x, pole)) << 0, pole == 0 ? 1 : -1, 0;
  }
  return mesh;
}

TEST(NormalCapture, OfAMeshMayHaveAnOpenSeamAndAGap) {
  const Mesh globe = open_globe(32);
  EXPECT_LT(farthest_from(normal_capture(globe, globe.positions), itself), 0.5);
  Positions normals = globe.positions;
  normals.row(33 * 32 + 7).setConstant(std::nan(""));
  normals.row(33 * 32 + 9).setZero();
  EXPECT_LT(farthest_from(normal_capture(globe, normals), itself), 6);
}

TEST(NormalCapture, OfAMeshThatIsNoSphereIsRefused) {
  const Mesh ball = sphere(1, 3);
  Mesh inside_out = ball, half = ball;
  inside_out.triangles = Triangles(ball.triangles.rowwise().reverse());
  half.triangles.conservativeResize(ball.triangles.rows() / 2, 3);
  expect_refused([&] { normal_capture(inside_out, ball.positions); }, "flip its faces");
  expect_refused([&] { normal_capture(half, ball.positions); }, "whole sphere");
  const Mesh ring = torus();
  expect_refused([&] { normal_capture(ring, ring.positions); }, "counter-clockwise");
  expect_refused([&] { normal_capture(ball, ball.positions.topRows(3)); }, "3 rows");
  expect_refused([&] { normal_capture(ball, Positions::Zero(ball.positions.rows(), 3)); }, "100 % of the sphere");
  expect_refused(
      [&] {
        normal_capture(Mesh{Positions::Zero(3, 3), Triangles{{0, 1, 2}}}, Positions::Zero(3, 3));
      },
      "no triangle has an area");
}

TEST(NormalCapture, OfEachPointItselfMovesNothingMuch) {
  const Mesh mesh = torus(1, 0.4, 24, 12);
  for (const SphereMap& map : {normal_capture(globe(128), equirectangular), normal_capture(discs(128), hemispheres)}) {
    const StylizeResult result = stylize(mesh.positions, mesh.triangles, map, 1);
    EXPECT_LT((result.positions - mesh.positions).rowwise().norm().maxCoeff(), 0.01 * box_diagonal(mesh.positions));
  }
}

}  // namespace
}  // namespace swage::test
