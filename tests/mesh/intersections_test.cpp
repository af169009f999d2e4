#include "intersections.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "exact_overlap.h"
#include "shapes.h"

#ifdef _OPENMP
#include <omp.h>
#endif

namespace swage {
namespace {

using testing::ElementsAre;
using Pair = std::array<int, 2>;
using Pairs = std::vector<Pair>;

constexpr std::size_t kAll = 1'000'000;

Pairs crossings(const Mesh& mesh) {
  const Crossings found = self_intersections(mesh.positions, mesh.triangles, kAll);
  EXPECT_TRUE(found.complete);
  return found.pairs;
}

Mesh mesh_of(std::initializer_list<Eigen::RowVector3d> positions, std::initializer_list<Eigen::RowVector3i> triangles) {
  Mesh mesh{Positions(positions.size(), 3), Triangles(triangles.size(), 3)};
  Eigen::Index row = 0;
  for (const auto& p : positions) mesh.positions.row(row++) = p;
  row = 0;
  for (const auto& t : triangles) mesh.triangles.row(row++) = t;
  return mesh;
}

/// Every triangle with corners of its own.
Mesh torn(const Mesh& mesh) {
  Mesh result{Positions(mesh.triangles.size(), 3), Triangles(mesh.triangles.rows(), 3)};
  for (Eigen::Index c = 0; c < mesh.triangles.size(); ++c) {
    result.positions.row(c) = mesh.positions.row(mesh.triangles.data()[c]);
    result.triangles.data()[c] = static_cast<int>(c);
  }
  return result;
}

TEST(SelfIntersections, GoodSurfacesHaveNone) {
  for (const Mesh& mesh :
       {test::sphere(1, 4), test::torus(), test::box({1, 2, 3}, 7), test::sheet(9), test::cylinder(0.1, 3, 24, 9)}) {
    EXPECT_THAT(crossings(mesh), ElementsAre());
    EXPECT_THAT(crossings(torn(mesh)), ElementsAre());
  }
}

TEST(SelfIntersections, ASideThroughATriangle) {
  const auto across = [](double height) {
    return mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, height}, {0.2, 0.2, 1}, {3, 3, 1}},
                   {{0, 1, 2}, {3, 4, 5}});
  };
  EXPECT_THAT(crossings(across(-1)), ElementsAre(Pair{0, 1}));
  EXPECT_THAT(crossings(across(0)), ElementsAre(Pair{0, 1})) << "touching counts";
  EXPECT_THAT(crossings(across(1e-300)), ElementsAre());
}

TEST(SelfIntersections, AVertexOnASideThatDoesNotHaveIt) {
  const Mesh mesh =
      mesh_of({{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, -1, 0}, {2, -1, 0}}, {{0, 1, 2}, {3, 4, 5}});
  EXPECT_THAT(crossings(mesh), ElementsAre(Pair{0, 1}));
}

TEST(SelfIntersections, AtASharedVertex) {
  const auto fan = [](const Eigen::RowVector3d& d, const Eigen::RowVector3d& e) {
    return mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, d, e}, {{0, 1, 2}, {0, 3, 4}});
  };
  EXPECT_THAT(crossings(fan({-1, 0, 0}, {0, -1, 0})), ElementsAre());
  EXPECT_THAT(crossings(fan({1, 1, 1}, {1, 1, -1})), ElementsAre(Pair{0, 1}));
  EXPECT_THAT(crossings(fan({0.2, 0.2, 0}, {0.1, 0.1, 1})), ElementsAre(Pair{0, 1})) << "a side within";
  EXPECT_THAT(crossings(fan({0.3, 0.2, 0}, {0.2, 0.3, 0})), ElementsAre(Pair{0, 1})) << "one within the other";
  EXPECT_THAT(crossings(fan({2, 0, 0}, {1, -1, 0})), ElementsAre(Pair{0, 1})) << "sides on each other";
}

TEST(SelfIntersections, AtASharedEdge) {
  const auto hinge = [](const Eigen::RowVector3d& d) {
    return mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, d}, {{0, 1, 2}, {1, 0, 3}});
  };
  EXPECT_THAT(crossings(hinge({0, -1, 0})), ElementsAre());
  EXPECT_THAT(crossings(hinge({0.5, 0.5, 1e-300})), ElementsAre());
  EXPECT_THAT(crossings(hinge({0.5, 0.5, 0})), ElementsAre(Pair{0, 1})) << "folded onto each other";
  EXPECT_THAT(crossings(hinge({5, 1, 0})), ElementsAre(Pair{0, 1}));
}

TEST(SelfIntersections, TheSameTriangleTwice) {
  const Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {2, 1, 0}, {0, 1, 2}});
  EXPECT_THAT(crossings(mesh), ElementsAre(Pair{0, 1}, Pair{0, 2}, Pair{1, 2}));
  EXPECT_EQ(crossings(torn(mesh)).size(), 3u);
}

TEST(SelfIntersections, ATriangleOfNoAreaHasNone) {
  const Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, -1}, {0.2, 0.2, 1}, {0.2, 0.2, 3}},
                            {{0, 1, 2}, {3, 4, 5}, {3, 4, 4}});
  EXPECT_THAT(crossings(mesh), ElementsAre());
}

TEST(SelfIntersections, AgreeWithIntegersOnRandomSoups) {
  std::size_t crossed = 0, apart = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    const test::IntegerSoup soup = test::integer_soup(seed);
    Pairs expected;
    for (int a = 0; a < soup.size(); ++a) {
      for (int b = a + 1; b < soup.size(); ++b) {
        if (soup.overlap(a, b)) expected.push_back({a, b});
      }
    }
    crossed += expected.size();
    apart += static_cast<std::size_t>(soup.size() * (soup.size() - 1)) / 2 - expected.size();
    for (const double unit : {1.0, 0x1p-1000, 0x1p+39}) {
      ASSERT_EQ(crossings({unit * soup.positions(), soup.triangles()}), expected) << "seed " << seed;
    }
  }
  EXPECT_GT(crossed, 10000u);
  EXPECT_GT(apart, 10000u);
}

TEST(SelfIntersections, OfTwoSpheresLieAlongACircle) {
  const Mesh mesh = test::joined(test::sphere(1, 4), test::transformed(test::sphere(1, 4), 1, {1.2, 0.01, 0.02}));
  const int count = static_cast<int>(test::sphere(1, 4).triangles.rows());
  const Pairs pairs = crossings(mesh);
  EXPECT_GT(pairs.size(), 200u);
  for (const auto& [a, b] : pairs) {
    EXPECT_TRUE(a < count && b >= count);
    EXPECT_NEAR(mesh.positions(mesh.triangles(a, 0), 0), 0.6, 0.1);
  }
  EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
}

TEST(SelfIntersections, EndWithAsManyAsWanted) {
  const test::IntegerSoup soup = test::integer_soup(3);
  const Pairs all = crossings({soup.positions(), soup.triangles()});
  for (const std::size_t most : {std::size_t{0}, std::size_t{1}, all.size() - 1, all.size()}) {
    const Crossings found = self_intersections(soup.positions(), soup.triangles(), most);
    EXPECT_EQ(found.pairs.size(), most);
    EXPECT_EQ(found.complete, most == all.size());
    EXPECT_TRUE(std::includes(all.begin(), all.end(), found.pairs.begin(), found.pairs.end()));
  }
}

TEST(SelfIntersections, EndWhereToldTo) {
  const Mesh mesh = test::sphere(1, 7);
  double last = 0;
  const auto unless = [&last](bool stops) {
    return [&last, stops](double part) {
      EXPECT_TRUE(part > last && part <= 1);
      last = part;
      return !stops;
    };
  };
  EXPECT_FALSE(self_intersections(mesh.positions, mesh.triangles, kAll, unless(true)).complete);
  EXPECT_LT(last, 1);
  last = 0;
  EXPECT_TRUE(self_intersections(mesh.positions, mesh.triangles, kAll, unless(false)).complete);
  EXPECT_EQ(last, 1);
}

#ifdef _OPENMP
TEST(SelfIntersections, AreTheSameForAnyNumberOfThreads) {
  const Mesh mesh = test::joined(test::torus(), test::transformed(test::torus(), 1, {0.3, 0.2, 0.1}));
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const Pairs all = crossings(mesh), some = self_intersections(mesh.positions, mesh.triangles, 50).pairs;
  EXPECT_GT(all.size(), 100u);
  for (const int count : {2, 5}) {
    omp_set_num_threads(count);
    EXPECT_EQ(crossings(mesh), all);
    EXPECT_EQ(self_intersections(mesh.positions, mesh.triangles, 50).pairs, some);
  }
  omp_set_num_threads(threads);
}
#endif

}  // namespace
}  // namespace swage
