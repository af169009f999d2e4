// Shapes to take styles from, their directions, and their way to the sphere.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "adjacency.h"
#include "measures.h"
#include "shapes.h"
#include "stylized.h"
#include "swage/error.h"
#include "swage/stylize.h"

namespace swage::test {
namespace {

using testing::HasSubstr;

TEST(StyleShapes, AreClosedAndHaveTheirFaces) {
  const std::vector<std::pair<Mesh, int>> all = {{style_shape(StyleShape::tetrahedron), 4},
                                                 {style_shape(StyleShape::cube), 6},
                                                 {style_shape(StyleShape::octahedron), 8},
                                                 {style_shape(StyleShape::dodecahedron), 12},
                                                 {style_shape(StyleShape::icosahedron), 20},
                                                 {prism(3), 5},
                                                 {prism(8), 10},
                                                 {bipyramid(8), 16}};
  for (const auto& [mesh, faces] : all) {
    EXPECT_EQ(closest_normals(mesh).normals.rows(), faces);
    const Edges edges = edges_of(mesh.triangles);
    for (int e = 0; e < edges.triangles.size(); ++e) ASSERT_EQ(edges.triangles[e].size(), 2) << faces;
    EXPECT_GT(volume(mesh), 0) << faces;
    EXPECT_LE(mesh.positions.rowwise().norm().maxCoeff(), 1.2) << faces;
  }
  EXPECT_THROW(prism(2), InvalidInput);
  EXPECT_THROW(bipyramid(2), InvalidInput);
  EXPECT_THROW(rounded_cube(0), InvalidInput);
  EXPECT_THROW(rounded_cube(0.3, 1), InvalidInput);
}

TEST(StyleShapes, TrianglesWithoutAreaAreNoFaces) {
  Mesh cube = style_shape(StyleShape::cube);
  cube.triangles.row(3) << 1, 1, 2;
  EXPECT_EQ(closest_normals(cube).normals.rows(), 6);
}

TEST(StyleShapes, NormalsFartherApartThanTheToleranceAreDistinct) {
  const Mesh ball = sphere(1, 3);
  const Positions normals = unit_normals(ball.positions, ball.triangles);
  for (const double tolerance : {0.0, 1e-3, 3.0, 20.0, 180.0}) {
    const double least = std::cos(tolerance * std::numbers::pi / 180);
    Positions kept(0, 3);
    for (const Eigen::RowVector3d normal : normals.rowwise()) {
      if (kept.rows() > 0 && (kept * normal.transpose()).maxCoeff() >= least) continue;
      kept.conservativeResize(kept.rows() + 1, 3);
      kept.bottomRows(1) = normal;
    }
    EXPECT_EQ(closest_normals(ball, tolerance).normals.rows(), kept.rows()) << tolerance;
  }
}

TEST(SphereMap, OfASphereIsTheSphere) {
  const SphereMap map = sphere_map(transformed(sphere(1, 3), 7, {3, 2, 1}));
  EXPECT_LT((map.directions - map.normals).rowwise().norm().maxCoeff(), 0.02);
  const Mesh shape = torus(1, 0.4, 24, 12);
  const Positions still = stylize(shape.positions, shape.triangles, map, 1).positions;
  EXPECT_LT(far_apart(shape.positions, still), 0.01);
}

TEST(SphereMap, OfARoundedCubeMakesCubes) {
  const SphereMap between = sphere_map(rounded_cube(0.2, 12)), nearest = sphere_map(rounded_cube(0.2, 12), true);
  const Mesh shape = askew(sphere(1, 3));
  const Positions normals = cube_normals().normals;
  for (const SphereMap& map : {between, nearest}) {
    const Positions cubic = stylize(shape.positions, shape.triangles, map, 10).positions;
    EXPECT_LT(mean_angle(shape, cubic, normals), 0.5 * mean_angle(shape, shape.positions, normals));
  }
}

TEST(SphereMap, RefusesWhatIsNoSphere) {
  const auto refused = [](const Mesh& mesh, const char* words) {
    try {
      sphere_map(mesh);
      ADD_FAILURE() << "not refused: " << words;
    } catch (const Unsolvable& no_sphere) {
      EXPECT_THAT(no_sphere.what(), HasSubstr(words));
    }
  };
  refused(sheet(4), "closed");
  refused(torus(1, 0.4, 12, 8), "tunnels");
  refused(joined(sphere(1, 1), transformed(sphere(1, 1), 1, {4, 0, 0})), "2 components");
  Mesh inside_out = sphere(1, 1);
  inside_out.triangles = Triangles(inside_out.triangles.rowwise().reverse());
  refused(inside_out, "folded");
}

}  // namespace
}  // namespace swage::test
