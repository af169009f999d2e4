#include "swage/diagnose.h"

#include <gtest/gtest.h>

#include <numbers>

#include "defects.h"
#include "mesh_index.h"
#include "places.h"
#include "shapes.h"
#include "swage/error.h"

namespace swage {
namespace {

using Pair = std::array<int, 2>;

Diagnosis diagnose(const Mesh& mesh) { return swage::diagnose(mesh.positions, mesh.triangles); }

Mesh tetrahedron() {
  Mesh mesh{Positions(4, 3), Triangles(4, 3)};
  mesh.positions << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  mesh.triangles << 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3;
  return mesh;
}

/// With another vertex and another triangle.
Mesh with_triangle(Mesh mesh, const Eigen::RowVector3d& vertex, const Eigen::RowVector3i& triangle) {
  mesh.positions.conservativeResize(mesh.positions.rows() + 1, 3);
  mesh.positions.bottomRows(1) = vertex;
  mesh.triangles.conservativeResize(mesh.triangles.rows() + 1, 3);
  mesh.triangles.bottomRows(1) = triangle;
  return mesh;
}

TEST(Diagnose, AGoodMeshHasNothingWrong) {
  const Diagnosis found = diagnose(test::torus());
  EXPECT_EQ(found.components, 1);
  EXPECT_EQ(found.welded_components, 1);
  for (const FoundPairs& pairs :
       {found.boundary_edges, found.non_manifold_edges, found.inconsistent_edges, found.self_intersections}) {
    EXPECT_EQ(pairs.count, 0);
    EXPECT_EQ(pairs.first, (Pair{-1, -1}));
  }
  for (const FoundElements& elements : {found.non_manifold_vertices, found.degenerate_triangles,
                                        found.duplicate_triangles, found.duplicate_vertices, found.isolated_vertices}) {
    EXPECT_EQ(elements.count, 0);
    EXPECT_EQ(elements.first, -1);
  }
  EXPECT_EQ(found.boundary_loops, 0);
  EXPECT_TRUE(found.self_intersections_complete);
  EXPECT_NEAR(found.volume.value(), 2 * std::pow(std::numbers::pi * 0.4, 2), 0.05);
}

TEST(Diagnose, NamesThePlaceOfEachDefect) {
  const Diagnosis fin = diagnose(with_triangle(tetrahedron(), {3, 3, 3}, {1, 3, 4}));
  EXPECT_EQ(fin.non_manifold_edges.first, (Pair{1, 3}));
  EXPECT_EQ(fin.boundary_edges.first, (Pair{1, 4}));
  EXPECT_EQ(fin.boundary_edges.count, 2);

  const Diagnosis twice = diagnose(with_triangle(tetrahedron(), {0, 1, 0}, {3, 2, 1}));
  EXPECT_EQ(twice.duplicate_triangles.first, 4);
  EXPECT_EQ(twice.duplicate_vertices.first, 4);
  EXPECT_EQ(twice.isolated_vertices.first, 4);
  EXPECT_EQ(twice.self_intersections.first, (Pair{2, 4}));

  Mesh turned = tetrahedron();
  turned.triangles.row(3) << 0, 2, 3;
  EXPECT_EQ(diagnose(turned).inconsistent_edges.first, (Pair{0, 2}));
  EXPECT_EQ(diagnose(turned).inconsistent_edges.count, 3);

  const Mesh touching = test::joined(tetrahedron(), test::transformed(tetrahedron(), -1, {0, 0, 0}));
  Mesh bow = touching;
  for (int& v : bow.triangles.reshaped()) v = v == 4 ? 0 : v;
  EXPECT_EQ(diagnose(bow).non_manifold_vertices.first, 0);
  EXPECT_EQ(diagnose(bow).non_manifold_vertices.count, 1);
  EXPECT_EQ(diagnose(touching).components, 2);
  EXPECT_EQ(diagnose(touching).welded_components, 1);

  const Diagnosis flat = diagnose(with_triangle(tetrahedron(), {0.5, 0, 0}, {0, 1, 4}));
  EXPECT_EQ(flat.degenerate_triangles.first, 4);
  EXPECT_EQ(flat.degenerate_triangles.count, 1);
  EXPECT_NEAR(flat.smallest_angle, std::numbers::pi / 4, 1e-12) << "of those with area";
  EXPECT_NEAR(flat.needle_fraction, 0.2, 1e-12);
  EXPECT_EQ(flat.self_intersections.count, 0);
}

TEST(Diagnose, ATriangleThatNamesAVertexTwiceIsNoPartOfTheSurface) {
  const Diagnosis found = diagnose(with_triangle(tetrahedron(), {5, 5, 5}, {1, 2, 2}));
  EXPECT_EQ(found.degenerate_triangles.first, 4);
  EXPECT_EQ(found.non_manifold_edges.count, 0);
  EXPECT_EQ(found.boundary_edges.count, 0);
  EXPECT_TRUE(found.volume.has_value());
}

TEST(Diagnose, EdgesAndAnglesOfASheet) {
  const Diagnosis found = diagnose(test::sheet(4));
  // 40 sides of squares and 16 diagonals.
  const double mean = 0.25 * (40 + 16 * std::sqrt(2.0)) / 56;
  EXPECT_NEAR(found.mean_edge, mean, 1e-15);
  EXPECT_NEAR(found.longest_to_mean_edge, 0.25 * std::sqrt(2.0) / mean, 1e-12);
  EXPECT_NEAR(found.smallest_angle, std::numbers::pi / 4, 1e-12);
  EXPECT_NEAR(found.low_angle, std::numbers::pi / 4, 1e-12);
  EXPECT_EQ(found.needle_fraction, 0);
  EXPECT_EQ(found.boundary_edges.count, 16);
  EXPECT_EQ(found.boundary_loops, 1);
  EXPECT_FALSE(found.volume.has_value());
}

TEST(Diagnose, LooksForAsManySelfIntersectionsAsWanted) {
  const Mesh mesh = test::joined(test::box(), test::transformed(test::box(), 1, {0.3, 0.2, 0.1}));
  const int all = diagnose(mesh).self_intersections.count;
  EXPECT_GT(all, 20);
  for (const int limit : {0, 1, all - 1, all}) {
    const Diagnosis found = swage::diagnose(mesh.positions, mesh.triangles, {}, limit);
    EXPECT_EQ(found.self_intersections.count, limit);
    EXPECT_EQ(found.self_intersections_complete, limit == all);
  }
  EXPECT_THROW(swage::diagnose(mesh.positions, mesh.triangles, {}, -1), InvalidInput);
  EXPECT_THROW(swage::diagnose(mesh.positions, Triangles(0, 3)), InvalidInput);
}

TEST(Diagnose, TheSearchForSelfIntersectionsIsCancelled) {
  const Mesh mesh = test::sphere(1, 6);
  const Diagnosis found = swage::diagnose(mesh.positions, mesh.triangles, [](const Progress& now) {
    EXPECT_STREQ(now.stage, "self-intersections");
    return false;
  });
  EXPECT_EQ(found.triangles, 81920);
  EXPECT_NEAR(found.volume.value(), 4 * std::numbers::pi / 3, 0.01);
}

const std::vector<std::pair<const char*, int (*)(const Diagnosis&)>> kCounts = {
    {"comps", [](const Diagnosis& d) { return d.components; }},
    {"welded_comps", [](const Diagnosis& d) { return d.welded_components; }},
    {"boundary", [](const Diagnosis& d) { return d.boundary_edges.count; }},
    {"nm_edges", [](const Diagnosis& d) { return d.non_manifold_edges.count; }},
    {"nm_verts", [](const Diagnosis& d) { return d.non_manifold_vertices.count; }},
    {"misoriented", [](const Diagnosis& d) { return d.inconsistent_edges.count; }},
    {"dup_verts", [](const Diagnosis& d) { return d.duplicate_vertices.count; }},
    {"dup_faces", [](const Diagnosis& d) { return d.duplicate_triangles.count; }},
    {"isolated_verts", [](const Diagnosis& d) { return d.isolated_vertices.count; }},
    {"self_int_pairs", [](const Diagnosis& d) { return d.self_intersections.count; }}};

const std::vector<std::pair<const char*, double (*)(const Diagnosis&)>> kMeasures = {
    {"edge_min_over_mean", [](const Diagnosis& d) { return d.shortest_edge / d.mean_edge; }},
    {"edge_max_over_mean", [](const Diagnosis& d) { return d.longest_to_mean_edge; }},
    {"min_angle", [](const Diagnosis& d) { return d.smallest_angle * 180 / std::numbers::pi; }},
    {"p5_angle", [](const Diagnosis& d) { return d.low_angle * 180 / std::numbers::pi; }},
    {"frac_angle_lt10", [](const Diagnosis& d) { return d.needle_fraction; }}};

TEST(Diagnose, RealMeshesAreAsOthersFoundThem) {
  if (!test::has_shared()) GTEST_SKIP() << "no real meshes beside this checkout";
  int compared = 0, measured = 0;
  for (const test::ListedMesh& listed : test::listed_meshes()) {
    SCOPED_TRACE(listed.name);
    const Mesh mesh = listed.in_fans();
    const Diagnosis found = diagnose(mesh);
    ++compared;
    for (const auto& [column, count] : kCounts) EXPECT_EQ(count(found), listed.number(column)) << column;
    // Listed are also triangles whose height over longest side is some 1e-8, and edges from a vertex to itself.
    EXPECT_LE(found.degenerate_triangles.count, listed.number("degenerate"));
    const bool is_alike = found.degenerate_triangles.count == listed.number("degenerate") &&
                          without_repeats(mesh.triangles).rows() == mesh.triangles.rows();
    if (!is_alike) continue;
    ++measured;
    for (const auto& [column, measure] : kMeasures) {
      const double due = listed.real(column);
      EXPECT_NEAR(measure(found), due, 1e-4 * due + 1e-6) << column;
    }
  }
  EXPECT_GT(compared, 190);
  EXPECT_GT(measured, 180);
}

}  // namespace
}  // namespace swage
