#include "split_edges.h"

#include <gtest/gtest.h>

#include "adjacency.h"
#include "measures.h"
#include "shapes.h"

namespace swage::test {
namespace {

double longest_edge(const Mesh& mesh) {
  double longest = 0;
  const Edges edges = edges_of(mesh.triangles);
  for (const auto& edge : edges.vertices.rowwise()) {
    longest = std::max(longest, (mesh.positions.row(edge[0]) - mesh.positions.row(edge[1])).norm());
  }
  return longest;
}

class SplitEdges : public testing::TestWithParam<double> {};

TEST_P(SplitEdges, KeepTheSurface) {
  const Mesh coarse = box({1, 2, 0.5}, 1);
  const Mesh fine = split_long_edges(coarse, GetParam(), 100000);
  EXPECT_LE(longest_edge(fine), GetParam());
  EXPECT_EQ(fine.positions.topRows(coarse.positions.rows()), coarse.positions);
  // Of the box: its area, its volume by the divergence theorem, and Euler's characteristic.
  const Positions areas = area_vectors(fine.positions, fine.triangles);
  EXPECT_NEAR(areas.rowwise().norm().sum() / 2, 7, 1e-12);
  double volume = 0;
  for (Eigen::Index t = 0; t < areas.rows(); ++t) {
    volume += fine.positions.row(fine.triangles(t, 0)).dot(areas.row(t)) / 6;
  }
  EXPECT_NEAR(volume, 1, 1e-12);
  const Edges edges = edges_of(fine.triangles);
  EXPECT_EQ(fine.positions.rows() - edges.vertices.rows() + fine.triangles.rows(), 2);
  for (int e = 0; e < edges.triangles.size(); ++e) EXPECT_EQ(edges.triangles[e].size(), 2);
}

INSTANTIATE_TEST_SUITE_P(Of, SplitEdges, testing::Values(3, 2.2, 2, 1, 0.6, 0.31, 0.1));

TEST(SplitEdges, LeaveShortOnesAlone) {
  const Mesh mesh = box({1, 2, 0.5}, 1);
  EXPECT_EQ(split_long_edges(mesh, 3, 100).triangles, mesh.triangles);
}

TEST(SplitEdges, StopBeforeThereAreTooMany) {
  const Mesh mesh = box({1, 2, 0.5}, 1);
  for (int most = 12; most < 200; ++most) {
    const Mesh fine = split_long_edges(mesh, 0.1, most);
    EXPECT_LE(fine.triangles.rows(), most);
    EXPECT_GT(fine.triangles.rows(), most - 2) << "an edge has two triangles";
    const Edges edges = edges_of(fine.triangles);
    for (int e = 0; e < edges.triangles.size(); ++e) EXPECT_EQ(edges.triangles[e].size(), 2);
  }
  // The longest first: the sides' diagonals.
  EXPECT_LT(longest_edge(split_long_edges(mesh, 0.1, 16)), longest_edge(mesh));
}

TEST(SplitEdges, TakeAnEdgeOfThreeTriangles) {
  Mesh fins;
  fins.positions.resize(5, 3);
  fins.positions << 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, -1, 0, 0;
  fins.triangles.resize(3, 3);
  fins.triangles << 0, 1, 2, 0, 1, 3, 0, 1, 4;
  const Mesh fine = split_long_edges(fins, 0.8, 100);
  EXPECT_LE(longest_edge(fine), 0.8);
  EXPECT_EQ(fine.positions.rows(), 5 + 1 + 3 * 2);
  EXPECT_EQ(fine.triangles.rows(), 12);
}

}  // namespace
}  // namespace swage::test
