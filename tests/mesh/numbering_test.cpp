#include "numbering.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "adjacency.h"
#include "shapes.h"

namespace swage {
namespace {

bool is_permutation_of_all(std::vector<int> numbers, Eigen::Index count) {
  std::vector<int> all(static_cast<size_t>(count));
  std::iota(all.begin(), all.end(), 0);
  std::sort(numbers.begin(), numbers.end());
  return numbers == all;
}

/// How far apart the two vertices of an edge stand on average.
double mean_distance(const Mesh& mesh) {
  const Edges edges = edges_of(mesh.triangles);
  return (edges.vertices.col(1) - edges.vertices.col(0)).cast<double>().mean();
}

TEST(Numbering, HasEachElementOnce) {
  const Mesh two = test::joined(test::sphere(1, 2), test::transformed(test::box(), 1, {5, 0, 0}));
  Mesh mesh = two;  // And a vertex of no triangle.
  mesh.positions.conservativeResize(two.positions.rows() + 1, Eigen::NoChange);
  const Numbering numbering = by_neighbourhood(mesh, edges_of(mesh.triangles));
  EXPECT_TRUE(is_permutation_of_all(numbering.vertices, mesh.positions.rows()));
  EXPECT_TRUE(is_permutation_of_all(numbering.triangles, mesh.triangles.rows()));
  EXPECT_TRUE(is_permutation_of_all(inverse(numbering.vertices), mesh.positions.rows()));
}

TEST(Numbering, LeavesEveryTriangleWhereItIs) {
  const Mesh mesh = test::sphere(1, 2);
  const Numbering numbering = by_neighbourhood(mesh, edges_of(mesh.triangles));
  const Mesh other = in_order(mesh, numbering);
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(other.positions.row(other.triangles(t, k)),
                mesh.positions.row(mesh.triangles(numbering.triangles[static_cast<size_t>(t)], k)));
    }
  }
}

TEST(Numbering, HasNeighboursNearEachOther) {
  const Mesh mesh = test::subdivided(test::subdivided(test::torus()));
  const Mesh other = in_order(mesh, by_neighbourhood(mesh, edges_of(mesh.triangles)));
  EXPECT_LT(mean_distance(other), 0.05 * mean_distance(mesh));
}

}  // namespace
}  // namespace swage
