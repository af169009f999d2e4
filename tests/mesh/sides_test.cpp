#include "sides.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "carried.h"
#include "shapes.h"

namespace swage {
namespace {

Lists corners_of(const Triangles& triangles) { return corners_of_vertices(triangles, triangles.maxCoeff() + 1); }

/// Few vertices, so that edges have many sides and triangles are there more than once.
Triangles random_triangles(int count, int vertices) {
  std::mt19937 random(2);
  std::uniform_int_distribution<int> vertex(0, vertices - 1);
  return Triangles::NullaryExpr(count, 3, [&] { return vertex(random); });
}

TEST(Sides, StandWhereTheirCornersDo) {
  for (int side = 0; side < 9; ++side) {
    EXPECT_EQ(next_in_triangle(side), side / 3 * 3 + (side + 1) % 3);
    EXPECT_EQ(previous_in_triangle(next_in_triangle(side)), side);
  }
}

TEST(Sides, CornersOfVerticesAreAllOfThem) {
  const Triangles triangles = random_triangles(500, 37);
  const Lists corners = corners_of_vertices(triangles, 40);
  ASSERT_EQ(corners.size(), 40);
  int count = 0;
  for (int v = 0; v < 40; ++v) {
    EXPECT_TRUE(std::is_sorted(corners[v].begin(), corners[v].end()));
    for (const int corner : corners[v]) EXPECT_EQ(triangles.data()[corner], v);
    count += corners[v].size();
  }
  EXPECT_EQ(count, triangles.size());
}

TEST(Sides, OfAnEdgeAreARing) {
  const Triangles few = random_triangles(400, 20);
  for (const Triangles& triangles : {test::torus().triangles, test::sheet(5).triangles, few}) {
    const NextSides next = next_sides(triangles, corners_of(triangles));
    std::map<std::set<int>, std::set<int>> due;
    const auto ends = [&](int side) {
      return std::set<int>{triangles.data()[side], triangles.data()[next_in_triangle(side)]};
    };
    for (int side = 0; side < triangles.size(); ++side) due[ends(side)].insert(side);
    for (int side = 0; side < triangles.size(); ++side) {
      std::set<int> ring{side};
      for (int other = next.data()[side]; other != side; other = next.data()[other]) {
        ASSERT_TRUE(ring.insert(other).second) << "not a ring";
      }
      EXPECT_EQ(ring, ends(side).size() == 1 ? std::set<int>{side} : due[ends(side)]);
      EXPECT_TRUE(next.data()[side] > side || next.data()[side] == *ring.begin()) << "ascending";
    }
  }
}

TEST(Sides, FirstsAlikeHaveTheSameVertices) {
  const Triangles triangles = random_triangles(400, 9);
  const std::vector<int> firsts = firsts_alike(triangles, corners_of(triangles));
  std::map<std::set<int>, int> due;
  for (int t = 0; t < triangles.rows(); ++t) {
    const std::set<int> vertices(triangles.row(t).begin(), triangles.row(t).end());
    if (vertices.size() < 3) continue;
    EXPECT_EQ(firsts[static_cast<size_t>(t)], due.emplace(vertices, t).first->second);
  }
  EXPECT_GT(due.size(), 50);  // Of 84 that there can be.
}

TEST(Sides, WindAlikeWhereTheyCan) {
  Mesh mesh = test::joined(test::torus(), test::sheet(4));
  const Triangles due = mesh.triangles;
  EXPECT_EQ(wind_alike(mesh.triangles, next_sides(due, corners_of(due))), 0);
  EXPECT_EQ(mesh.triangles, due);
  int turned = 0;
  for (int t = 1; t < due.rows(); t += 3, ++turned) std::swap(mesh.triangles(t, 1), mesh.triangles(t, 2));
  EXPECT_EQ(wind_alike(mesh.triangles, next_sides(mesh.triangles, corners_of(mesh.triangles))), turned);
  EXPECT_EQ(mesh.triangles, due);
}

TEST(Sides, OfABandWithOneSideWindAlikeButForOneEdge) {
  const int count = 20;
  Triangles band(2 * count, 3);
  for (int i = 0; i < count; ++i) {
    // Across the seam upper and lower change places.
    const int a = 2 * i, b = 2 * i + 1, c = i + 1 < count ? a + 2 : 1, d = i + 1 < count ? a + 3 : 0;
    band.row(2 * i) << a, c, b;
    band.row(2 * i + 1) << b, c, d;
  }
  const Lists corners = corners_of(band);
  wind_alike(band, next_sides(band, corners));
  const NextSides next = next_sides(band, corners_of(band));
  int against = 0;
  for (int side = 0; side < band.size(); ++side) {
    against += next.data()[side] > side && same_way(band, side, next.data()[side]) ? 1 : 0;
  }
  EXPECT_EQ(against, 1);
}

}  // namespace
}  // namespace swage
