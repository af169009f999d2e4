#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <set>

#include "adjacency.h"
#include "chains.h"
#include "shapes.h"
#include "swage/error.h"
#include "swage/features.h"

namespace swage {
namespace {

using test::Chains;
using test::edges_in;
using test::kDegree;

/// Of the mesh, with what holds for chains of any.
Chains chains_of(const Mesh& mesh, const StraightOptions& options = {}) {
  const Chains chains = straight_chains(mesh.positions, mesh.triangles, options);
  EXPECT_TRUE(std::is_sorted(chains.begin(), chains.end()));
  const Edges edges = edges_of(mesh.triangles);
  std::set<std::pair<int, int>> all;
  for (const auto& edge : edges.vertices.rowwise()) all.emplace(edge[0], edge[1]);
  size_t count = 0;
  for (const std::vector<int>& chain : chains) {
    EXPECT_GE(chain.size(), 3U);
    EXPECT_NE(chain.front(), chain.back());
    const double length = (mesh.positions.row(chain.back()) - mesh.positions.row(chain.front())).norm();
    EXPECT_GE(length, options.shortest * box_diagonal(mesh.positions));
    count += chain.size() - 1;
  }
  const auto in_chains = edges_in(chains);
  EXPECT_EQ(in_chains.size(), count) << "an edge is in two chains";
  EXPECT_TRUE(std::includes(all.begin(), all.end(), in_chains.begin(), in_chains.end()));
  return chains;
}

/// A band along points, one unit wide in z: its rails are the points at z = 0 and, numbered after them, those at 1.
Mesh band(const std::vector<Eigen::Vector2d>& points) {
  const auto n = static_cast<int>(points.size());
  Mesh mesh{Positions(2 * n, 3), Triangles(2 * n - 2, 3)};
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector2d& point = points[static_cast<size_t>(i)];
    mesh.positions.row(i) << point[0], point[1], 0;
    mesh.positions.row(n + i) << point[0], point[1], 1;
  }
  for (int i = 0; i + 1 < n; ++i) {
    mesh.triangles.row(2 * i) << i, i + 1, n + i + 1;
    mesh.triangles.row(2 * i + 1) << i, n + i + 1, n + i;
  }
  return mesh;
}

/// A fan inside a closed curve about its middle.
Mesh disk(const std::vector<Eigen::Vector2d>& points) {
  const auto n = static_cast<int>(points.size());
  Mesh mesh{Positions::Zero(n + 1, 3), Triangles(n, 3)};
  for (int i = 0; i < n; ++i) {
    mesh.positions.row(i).head<2>() = points[static_cast<size_t>(i)];
    mesh.triangles.row(i) << i, (i + 1) % n, n;
  }
  mesh.positions.row(n) = mesh.positions.topRows(n).colwise().mean();
  return mesh;
}

/// Goes on from the last point by steps of a length, each turned by so much from the one before.
struct Path {
  std::vector<Eigen::Vector2d> points{{0, 0}};
  double heading = 0;

  Path& go(int steps, double step, double turn_each = 0) {
    for (int i = 0; i < steps; ++i) {
      heading += turn_each;
      points.push_back(points.back() + step * Eigen::Vector2d(std::cos(heading), std::sin(heading)));
    }
    return *this;
  }
  Path& turn(double angle) {
    heading += angle;
    return *this;
  }
};

Path arc(double angle, double length, int steps) { return Path().go(steps, length / steps, angle / steps); }

/// Chains along the rail at z = 0.
Chains on_rail(const Path& path, const StraightOptions& options = {}) {
  Chains chains = chains_of(band(path.points), options);
  std::erase_if(chains, [&](const auto& chain) { return chain[0] >= static_cast<int>(path.points.size()); });
  return chains;
}

TEST(StraightChains, ABoxHasTwelve) {
  for (const int cells : {2, 3, 8}) {
    const Chains chains = chains_of(test::box({1, 2, 3}, cells));
    EXPECT_EQ(chains.size(), 12U);
    for (const auto& chain : chains) EXPECT_EQ(chain.size(), static_cast<size_t>(cells) + 1);
  }
  EXPECT_TRUE(chains_of(test::box({1, 2, 3}, 1)).empty()) << "an edge alone is straight by itself";
}

TEST(StraightChains, DoNotDependOnHowTrianglesWindNorOnTheirOrder) {
  Mesh mesh = test::joined(test::box({1, 2, 3}, 4), test::cylinder(0.5, 1, 16, 5));
  const Chains chains = chains_of(mesh);
  EXPECT_EQ(chains.size(), 12U + 16U);
  std::mt19937 random(3);
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    if (random() % 2 == 0) std::swap(mesh.triangles(t, 0), mesh.triangles(t, 2));
    mesh.triangles.row(t).swap(mesh.triangles.row(static_cast<Eigen::Index>(random()) % (t + 1)));
  }
  EXPECT_EQ(chains_of(mesh), chains);
}

TEST(StraightChains, RimsOfACylinderHaveNoneHoweverFine) {
  for (const double shortest : {0.0, 0.05}) {
    for (const int segments : {8, 16, 32, 64, 100, 200}) {
      const Mesh mesh = test::cylinder(0.5, 1, segments, 2);
      StraightOptions options;
      options.shortest = shortest;
      for (const auto& chain : chains_of(mesh, options)) {
        EXPECT_GT(std::abs(mesh.positions(chain[0], 1) - mesh.positions(chain[1], 1)), 0.1) << segments << " segments";
      }
    }
  }
}

TEST(StraightChains, ACircleHasNoneHoweverFine) {
  for (const int segments : {90, 91, 360, 5000, 100'000}) {
    const Path circle = Path().go(segments - 1, 1, 2 * std::numbers::pi / segments);
    StraightOptions options;
    options.shortest = 0;
    EXPECT_TRUE(chains_of(disk(circle.points), options).empty()) << segments;
  }
}

TEST(StraightChains, SidesOfAPolygonOfElevenAreACurveThoseOfTenAreNot) {
  for (const int sides : {10, 11, 24, 60}) {
    const Mesh mesh = test::subdivided(test::cylinder(0.5, 1, sides, 1));
    StraightOptions options;
    options.shortest = 0.01;
    Chains chains = chains_of(mesh, options);
    std::erase_if(chains, [&](const auto& c) { return mesh.positions(c[0], 1) != mesh.positions(c[1], 1); });
    EXPECT_EQ(chains.size(), sides == 10 ? 20U : 0U) << sides;
  }
}

TEST(StraightChains, AnAngleSheetHasSix) {
  Mesh mesh = test::sheet(8);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    const Eigen::RowVector3d middle = mesh.positions(mesh.triangles.row(t), Eigen::all).colwise().mean();
    if (middle[0] < 0.5 || middle[1] < 0.5) kept.push_back(t);
  }
  mesh.triangles = mesh.triangles(kept, Eigen::all).eval();
  const Chains chains = chains_of(mesh);
  EXPECT_EQ(chains.size(), 6U);
  EXPECT_EQ(edges_in(chains).size(), 32U);
}

TEST(StraightChains, GoOnThroughTheJunctionsOfCrossedSheets) {
  // Four half sheets at one joint, whose vertices 0 to 4 lie along y.
  const int cells = 4;
  Mesh mesh = test::sheet(cells);
  const Mesh half = mesh;
  const std::vector<Eigen::Vector3d> ways = {{1, 0, 0}, {0, 0, 1}, {-1, 0, 0}, {0, 0, -1}};
  const int each = (cells + 1) * cells;
  mesh.positions.resize(cells + 1 + 4 * each, 3);
  mesh.triangles.resize(0, 3);
  for (int i = 0; i <= cells; ++i) mesh.positions.row(i) << 0, double(i) / cells, 0;
  for (int k = 0; k < 4; ++k) {
    const auto number = [&](int v) {
      const int i = v / (cells + 1), j = v % (cells + 1);
      return j == 0 ? i : cells + 1 + k * each + i * cells + j - 1;
    };
    for (int v = 0; v < half.positions.rows(); ++v) {
      const Eigen::RowVector3d at = half.positions.row(v);
      mesh.positions.row(number(v)) =
          at[0] * ways[static_cast<size_t>(k)].transpose() + Eigen::RowVector3d(0, at[1], 0);
    }
    const Eigen::Index before = mesh.triangles.rows();
    mesh.triangles.conservativeResize(before + half.triangles.rows(), 3);
    mesh.triangles.bottomRows(half.triangles.rows()) = half.triangles.unaryExpr(number);
  }
  const Chains chains = chains_of(mesh);
  // The joint, and of each whole sheet four sides, of which two run through the joint's ends.
  EXPECT_EQ(chains.size(), 1U + 2 * 4U);
  EXPECT_THAT(chains, testing::Contains(std::vector<int>{0, 1, 2, 3, 4}));
  EXPECT_EQ(std::count_if(chains.begin(), chains.end(), [&](const auto& c) { return c.size() == 2 * cells + 1; }), 4);
}

TEST(StraightChains, AreAsLongAsAskedAtLeast) {
  const Mesh mesh = test::box({3, 1, 0.2}, 4);  // The diagonal is 3.17.
  for (const auto& [shortest, count] :
       {std::pair(0.0, 12U), {0.06, 12U}, {0.07, 8U}, {0.31, 8U}, {0.32, 4U}, {1, 0U}}) {
    StraightOptions options;
    options.shortest = shortest;
    EXPECT_EQ(chains_of(mesh, options).size(), count) << shortest;
  }
}

TEST(StraightChains, FollowEdgesBelowTheAngleOnly) {
  for (const auto& [degrees, count] : {std::pair(89.0, 0U), {91.0, 12U}, {180.0, 12U}}) {
    StraightOptions options;
    options.feature_angle = degrees * kDegree;
    EXPECT_EQ(chains_of(test::box({1, 1, 1}, 4), options).size(), count) << degrees;
  }
}

TEST(StraightChains, TurnAtAVertexNoMoreThanAllowed) {
  const Path path = Path().go(10, 0.1).turn(3 * kDegree).go(10, 0.1);
  StraightOptions options;
  options.deviation = 0.02;
  options.turn = 2.9 * kDegree;
  EXPECT_EQ(on_rail(path, options).size(), 2U);
  options.turn = 3 * kDegree;
  EXPECT_EQ(on_rail(path, options),
            (Chains{{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20}}));
}

TEST(StraightChains, DeviateNoMoreThanAllowed) {
  // The middle is off by half of the sine of half of the turn.
  const Path path = Path().go(10, 0.1).turn(3 * kDegree).go(10, 0.1);
  const double off = std::sin(1.5 * kDegree) / 2;
  StraightOptions options;
  options.deviation = 1.001 * off;
  EXPECT_EQ(on_rail(path, options).size(), 1U);
  options.deviation = 0.999 * off;
  const Chains two = on_rail(path, options);
  ASSERT_EQ(two.size(), 2U);
  EXPECT_EQ(edges_in(two).size(), 20U);
}

TEST(StraightChains, AnArcIsStraightAsAWholeOrNotAtAll) {
  for (const int steps : {20, 200, 2000}) {
    for (const double shortest : {0.001, 0.05}) {
      StraightOptions options;
      options.shortest = shortest;
      const Chains shallow = on_rail(arc(1 * kDegree, 1, steps), options);
      ASSERT_EQ(shallow.size(), 1U) << steps;
      EXPECT_EQ(shallow[0].size(), static_cast<size_t>(steps) + 1);
      for (const double degrees : {2.0, 5.0, 20.0, 90.0, 270.0}) {
        if (degrees / steps > 4) continue;
        EXPECT_TRUE(on_rail(arc(degrees * kDegree, 1, steps), options).empty()) << degrees << " in " << steps;
      }
    }
  }
}

TEST(StraightChains, LinesThatRunIntoAnArcEndSoonAfter) {
  const Path path = Path().go(20, 0.1).go(200, 0.5 * 90 * kDegree / 200, 90 * kDegree / 200).go(20, 0.05);
  const Chains chains = on_rail(path);
  ASSERT_EQ(chains.size(), 2U);
  EXPECT_EQ(chains[0].front(), 0);
  EXPECT_GE(chains[0].back(), 20);
  EXPECT_LE(chains[0].back(), 20 + 16) << "more than 7 degrees of the arc";
  EXPECT_GE(chains[1].front(), 220 - 16);
  EXPECT_LE(chains[1].front(), 220);
  EXPECT_EQ(chains[1].back(), 240);
}

TEST(StraightChains, OfALoopAreItsStraightParts) {
  // A running track, without a corner.
  Path path = Path().go(20, 0.1).go(300, std::numbers::pi / 300, std::numbers::pi / 300).go(20, 0.1);
  path.go(299, std::numbers::pi / 300, std::numbers::pi / 300);
  const Chains chains = chains_of(disk(path.points));
  ASSERT_EQ(chains.size(), 2U);
  for (const auto& chain : chains) {
    EXPECT_GE(chain.size(), 21U);
    EXPECT_LE(chain.size(), 21U + 12) << "more than 7 degrees of the arcs";
  }
}

TEST(StraightChains, BearALittleNoise) {
  Path path = Path().go(30, 0.1);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> noise(-1e-3, 1e-3);
  for (Eigen::Vector2d& point : path.points) point[1] += noise(random);
  const Chains chains = on_rail(path);
  ASSERT_EQ(chains.size(), 1U);
  EXPECT_EQ(chains[0].size(), 31U);
}

TEST(StraightChains, EndAtAHub) {
  // Triangles that share vertex 0 alone, each with an opposite one.
  const int count = 4000;
  Mesh mesh{Positions::Zero(1 + 4 * count, 3), Triangles(2 * count, 3)};
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < 2; ++k) {
      const double angle = std::numbers::pi * (i + 0.5 * k) / count;
      const Eigen::RowVector3d tip(std::cos(angle), std::sin(angle), 0);
      mesh.positions.row(1 + 4 * i + k) = tip;
      mesh.positions.row(3 + 4 * i + k) = -tip;
    }
    mesh.triangles.row(2 * i) << 0, 1 + 4 * i, 2 + 4 * i;
    mesh.triangles.row(2 * i + 1) << 0, 3 + 4 * i, 4 + 4 * i;
  }
  EXPECT_TRUE(chains_of(mesh).empty());
  const Mesh few{mesh.positions, mesh.triangles.topRows(20)};
  EXPECT_EQ(chains_of(few).size(), 20U);
}

TEST(StraightChains, RefuseOptionsOutOfRange) {
  const Mesh mesh = test::box();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::pair<double StraightOptions::*, std::string>> options = {
      {&StraightOptions::feature_angle, "feature_angle"},
      {&StraightOptions::turn, "turn"},
      {&StraightOptions::deviation, "deviation"},
      {&StraightOptions::shortest, "shortest"}};
  for (const auto& [option, name] : options) {
    for (const double value : {-0.01, 3.2, nan}) {
      StraightOptions bad;
      bad.*option = value;
      EXPECT_THAT([&] { straight_chains(mesh.positions, mesh.triangles, bad); },
                  testing::ThrowsMessage<InvalidInput>(testing::HasSubstr("options." + name)));
    }
  }
  EXPECT_THROW(straight_chains(mesh.positions, mesh.triangles.topRows(0)), InvalidInput);
}

}  // namespace
}  // namespace swage
