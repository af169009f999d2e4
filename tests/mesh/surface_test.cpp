#include "surface.h"

#include <gtest/gtest.h>

#include "shapes.h"

namespace swage {
namespace {

/// The mesh with its own vertex for each corner of each triangle.
Mesh unwelded(const Mesh& mesh) {
  Mesh soup{Positions(mesh.triangles.size(), 3), mesh.triangles};
  for (int corner = 0; corner < mesh.triangles.size(); ++corner) {
    soup.positions.row(corner) = mesh.positions.row(mesh.triangles.data()[corner]);
    soup.triangles.data()[corner] = corner;
  }
  return soup;
}

int edges_with(const Edges& edges, int triangles) {
  int count = 0;
  for (int e = 0; e < edges.triangles.size(); ++e) count += edges.triangles[e].size() == triangles ? 1 : 0;
  return count;
}

TEST(Surface, OfAWellMadeMeshIsAsGiven) {
  const Mesh mesh = test::torus();
  const Surface surface = surface_of(mesh, 1e-6);
  EXPECT_TRUE(surface.is_as_given());
  EXPECT_EQ(surface.mesh.positions, mesh.positions);
  EXPECT_EQ(surface.mesh.triangles, mesh.triangles);
  EXPECT_EQ(surface.edges.vertices, edges_of(mesh.triangles).vertices);
}

TEST(Surface, OfASoupIsClosedAgain) {
  const Mesh mesh = test::box({1, 2, 3}, 3);
  const Surface surface = surface_of(unwelded(mesh), 0);
  EXPECT_EQ(surface.mesh.positions.rows(), mesh.positions.rows());
  EXPECT_EQ(surface.counts.merged, mesh.triangles.size() - mesh.positions.rows());
  EXPECT_EQ(edges_with(surface.edges, 2), surface.edges.vertices.rows());
  for (size_t v = 0; v < surface.vertex_of.size(); ++v) {
    EXPECT_EQ(surface.mesh.positions.row(surface.vertex_of[v]), unwelded(mesh).positions.row(static_cast<int>(v)));
  }
}

TEST(Surface, JoinsWithinTheToleranceOnly) {
  Mesh mesh = test::sheet(1);
  mesh.positions.conservativeResize(6, 3);
  mesh.positions.row(4) = mesh.positions.row(0) + Eigen::RowVector3d(0.9e-3, 0, 0);
  mesh.positions.row(5) = mesh.positions.row(0) + Eigen::RowVector3d(-1.1e-3, 0, 0);
  mesh.triangles.conservativeResize(4, 3);
  mesh.triangles.row(2) << 4, 1, 2;
  mesh.triangles.row(3) << 5, 1, 2;
  const Surface surface = surface_of(mesh, 1e-3);
  EXPECT_EQ(surface.vertex_of[4], surface.vertex_of[0]);
  EXPECT_NE(surface.vertex_of[5], surface.vertex_of[0]);
}

TEST(Surface, LeavesOutWhatIsThereTwiceOrNotAtAll) {
  Mesh mesh = test::box({1, 1, 1}, 2);
  const auto vertices = static_cast<int>(mesh.positions.rows()), triangles = static_cast<int>(mesh.triangles.rows());
  mesh.positions.conservativeResize(vertices + 1, 3);
  mesh.positions.row(vertices) << 5, 5, 5;
  mesh.triangles.conservativeResize(triangles + 3, 3);
  const Eigen::RowVector3i first = mesh.triangles.row(0);
  mesh.triangles.row(triangles) << first[1], first[2], first[0];
  mesh.triangles.row(triangles + 1) << first[0], first[2], first[1];
  mesh.triangles.row(triangles + 2) << first[0], first[0], first[1];
  const Surface surface = surface_of(mesh, 1e-6);
  EXPECT_EQ(surface.counts.repeated, 2);
  EXPECT_EQ(surface.counts.collapsed, 1);
  EXPECT_EQ(surface.counts.loose, 1);
  EXPECT_EQ(surface.mesh.triangles, mesh.triangles.topRows(triangles));
  EXPECT_EQ(surface.triangle_of[static_cast<size_t>(triangles)], 0);
  EXPECT_EQ(surface.triangle_of[static_cast<size_t>(triangles) + 1], 0);
  EXPECT_EQ(surface.triangle_of[static_cast<size_t>(triangles) + 2], -1);
  EXPECT_EQ(surface.vertex_of[static_cast<size_t>(vertices)], -1);
}

TEST(Surface, TurnsTrianglesToWindAlike) {
  Mesh mesh = test::torus();
  int turned = 0;
  for (int t = 1; t < mesh.triangles.rows(); t += 3, ++turned) std::swap(mesh.triangles(t, 0), mesh.triangles(t, 1));
  const Surface surface = surface_of(mesh, 1e-6);
  EXPECT_EQ(surface.counts.turned, turned);
  for (int e = 0; e < surface.edges.triangles.size(); ++e) {
    const Lists::Range beside = surface.edges.triangles[e];
    const Eigen::RowVector2i edge = surface.edges.vertices.row(e);
    EXPECT_NE(runs_along(surface.mesh.triangles, beside[0], edge), runs_along(surface.mesh.triangles, beside[1], edge));
  }
  const Edges anew = edges_of(surface.mesh.triangles);
  EXPECT_EQ(surface.edges.triangle_edges, anew.triangle_edges);
}

}  // namespace
}  // namespace swage
