// Polygons of a file become triangles that cover them in their winding.
#include "triangulate.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numeric>

#include "samples.h"

namespace swage::test {
namespace {

// Points of the plane, tilted into space.
Positions tilted(const std::vector<Eigen::Vector2d>& points) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2.1, Eigen::Vector3d(3, -1, 2).normalized()).matrix();
  Positions positions(static_cast<Eigen::Index>(points.size()), 3);
  for (size_t k = 0; k < points.size(); ++k) {
    positions.row(static_cast<Eigen::Index>(k)) = turn * Eigen::Vector3d(points[k].x(), points[k].y(), 0);
  }
  return positions;
}

std::vector<int> all_of(size_t count) {
  std::vector<int> polygon(count);
  std::iota(polygon.begin(), polygon.end(), 0);
  return polygon;
}

std::vector<int> cut(const std::vector<int>& polygon, const Positions& positions) {
  std::vector<int> triangles;
  EXPECT_TRUE(triangulate(polygon, positions, 20000, triangles));
  return triangles;
}

// Areas along the polygon's normal, one a triangle. They add up to the polygon's and none is negative only if the
// triangles cover it once.
void expect_covered(const std::vector<int>& polygon, const Positions& positions) {
  const std::vector<int> triangles = cut(polygon, positions);
  ASSERT_EQ(triangles.size(), 3 * (polygon.size() - 2));
  const Eigen::Vector3d whole = area_vector(polygon, positions);
  double sum = 0;
  for (size_t t = 0; t < triangles.size(); t += 3) {
    const double part =
        area_vector({triangles[t], triangles[t + 1], triangles[t + 2]}, positions).dot(whole.normalized());
    EXPECT_GE(part, -1e-12 * whole.norm());
    sum += part;
  }
  EXPECT_NEAR(sum, whole.norm(), 1e-9 * whole.norm());
}

TEST(Triangulate, ConvexPolygonsAreFanned) {
  const Positions hexagon = tilted({{1, 0}, {2, 0}, {3, 1}, {2, 2}, {1, 2}, {0, 1}});
  EXPECT_EQ(cut(all_of(6), hexagon), (std::vector<int>{0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5}));
  EXPECT_EQ(cut({3, 2, 1, 0}, hexagon), (std::vector<int>{3, 2, 1, 3, 1, 0}));
}

TEST(Triangulate, AConcaveQuadTakesTheDiagonalInside) {
  const std::vector<Eigen::Vector2d> dart = {{0, 0}, {2, -1}, {0.5, 0}, {2, 1}};
  for (int first = 0; first < 4; ++first) {
    std::vector<int> polygon(4);
    for (int k = 0; k < 4; ++k) polygon[static_cast<size_t>(k)] = (first + k) % 4;
    expect_covered(polygon, tilted(dart));
    expect_covered({polygon.rbegin(), polygon.rend()}, tilted(dart));
  }
}

TEST(Triangulate, ConcavePolygonsAreCovered) {
  std::vector<Eigen::Vector2d> star, spiral, comb;
  for (int k = 0; k < 40; ++k) {
    const double radius = k % 2 == 0 ? 1 : 0.3, angle = k * M_PI / 20;
    star.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  for (int k = 0; k < 60; ++k) spiral.emplace_back((5 + k) * std::cos(k * 0.2), (5 + k) * std::sin(k * 0.2));
  for (int k = 59; k >= 0; --k) spiral.emplace_back((3 + k) * std::cos(k * 0.2), (3 + k) * std::sin(k * 0.2));
  for (int k = 0; k < 20; ++k) comb.emplace_back(k, k % 2);
  comb.emplace_back(19, 5);
  comb.emplace_back(0, 5);
  for (const auto& points : {star, spiral, comb}) {
    expect_covered(all_of(points.size()), tilted(points));
  }
}

// One corner at a time can be cut, and a test of each corner for each would take minutes.
TEST(Triangulate, ALongThinSpiralIsCovered) {
  constexpr int kAlong = 4000;
  std::vector<Eigen::Vector2d> spiral(2 * kAlong);
  for (int k = 0; k < kAlong; ++k) {
    const double angle = k * (10 * M_PI / kAlong);
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    spiral[static_cast<size_t>(k)] = (1.0001 + angle) * direction;
    spiral[static_cast<size_t>(2 * kAlong - 1 - k)] = (1 + angle) * direction;
  }
  expect_covered(all_of(spiral.size()), tilted(spiral));
}

TEST(Triangulate, CornersInARowAndHolesWithABridge) {
  expect_covered(all_of(5), tilted({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}}));
  // The outer square, the bridge to the inner one, which runs the other way, and back.
  expect_covered({0, 1, 2, 3, 0, 4, 5, 6, 7, 4},
                 tilted({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 1}, {1, 3}, {3, 3}, {3, 1}}));
}

TEST(Triangulate, WhatCannotBeCoveredStillEnds) {
  const Positions flat = Positions::Zero(6, 3);
  EXPECT_EQ(cut(all_of(6), flat).size(), 12u);
  const Positions bow = tilted({{0, 0}, {2, 2}, {2, 0}, {0, 1.5}, {3, 3}, {1, 0}});
  EXPECT_EQ(cut(all_of(6), bow).size(), 12u);
  EXPECT_EQ(cut({0, 1, 0, 1, 2, 0, 2}, bow).size(), 15u);
}

TEST(Triangulate, RefusesConcavePolygonsBeyondTheLimit) {
  const Positions dart = tilted({{0, 0}, {2, -1}, {0.5, 0}, {2, 1}});
  std::vector<int> triangles;
  EXPECT_FALSE(triangulate({2, 3, 0, 1}, dart, 3, triangles) && triangulate({1, 2, 3, 0}, dart, 3, triangles));
}

}  // namespace
}  // namespace swage::test
