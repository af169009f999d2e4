// Curvatures of the same shape given otherwise, and of input that leaves nothing to fit.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#ifdef _OPENMP
#include <omp.h>
#endif

#include "shapes.h"
#include "swage/curvature.h"
#include "swage/error.h"

namespace swage {
namespace {

Curvatures curvature_of(const Mesh& mesh, const CurvatureOptions& options = {}) {
  return curvature(mesh.positions, mesh.triangles, options);
}

double relative_difference(const Curvatures& a, const Curvatures& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

Mesh shuffled(const Mesh& mesh, const std::vector<int>& vertex_order, const std::vector<int>& triangle_order) {
  Mesh result = mesh;
  std::vector<int> places(vertex_order.size());
  for (size_t i = 0; i < vertex_order.size(); ++i) places[static_cast<size_t>(vertex_order[i])] = static_cast<int>(i);
  result.positions = mesh.positions(vertex_order, Eigen::all);
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      // The first corner moves too.
      const int v = mesh.triangles(triangle_order[static_cast<size_t>(t)], (k + static_cast<int>(t)) % 3);
      result.triangles(t, k) = places[static_cast<size_t>(v)];
    }
  }
  return result;
}

std::vector<int> random_order(Eigen::Index count, unsigned seed) {
  std::vector<int> order(static_cast<size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(seed));
  return order;
}

Mesh mesh_of(const std::vector<Eigen::RowVector3d>& positions, const std::vector<Eigen::RowVector3i>& triangles) {
  Mesh mesh{Positions(positions.size(), 3), Triangles(triangles.size(), 3)};
  for (size_t i = 0; i < positions.size(); ++i) mesh.positions.row(static_cast<Eigen::Index>(i)) = positions[i];
  for (size_t i = 0; i < triangles.size(); ++i) mesh.triangles.row(static_cast<Eigen::Index>(i)) = triangles[i];
  return mesh;
}

TEST(CurvatureInput, GoesWithTheInverseOfTheScale) {
  const Mesh mesh = test::joined(test::torus(), test::transformed(test::cylinder(), 1, {3, 0, 0}));
  const Curvatures found = curvature_of(mesh);
  for (double scale : {1e-4, 1e4}) {
    const Curvatures scaled = curvature_of(test::transformed(mesh, scale, {0, 0, 0}));
    EXPECT_LT(relative_difference(scaled * scale, found), 1e-9) << "scale " << scale;
  }
  const Curvatures moved = curvature_of(test::transformed(mesh, 1, {10, -20, 30}));
  EXPECT_LT(relative_difference(moved, found), 1e-9);
}

TEST(CurvatureInput, DoesNotDependOnTheOrderOfVerticesAndTriangles) {
  const Mesh mesh = test::joined(test::joined(test::torus(), test::cylinder()), test::cylinder(1, 4, 12, 1));
  const std::vector<int> vertices = random_order(mesh.positions.rows(), 3);
  const std::vector<int> triangles = random_order(mesh.triangles.rows(), 4);
  const Curvatures found = curvature_of(mesh);
  EXPECT_LT(relative_difference(curvature_of(shuffled(mesh, vertices, triangles)), found(triangles, Eigen::all)), 1e-9);
}

TEST(CurvatureInput, TakesColumnMajorMatrices) {
  const Mesh mesh = test::torus();
  const Eigen::MatrixXd positions = mesh.positions;
  const Eigen::MatrixXi triangles = mesh.triangles;
  EXPECT_EQ(curvature(positions, triangles), curvature_of(mesh));
}

#ifdef _OPENMP
TEST(CurvatureInput, IsTheSameBytesForAnyNumberOfThreads) {
  const Mesh mesh = test::joined(test::torus(), test::cylinder());
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const Curvatures one = curvature_of(mesh);
  for (int count : {2, 5}) {
    omp_set_num_threads(count);
    EXPECT_EQ(curvature_of(mesh), one) << count << " threads";
  }
  omp_set_num_threads(threads);
}
#endif

TEST(CurvatureInput, OfDegenerateInputIsFinite) {
  const std::vector<std::pair<const char*, Mesh>> meshes{
      {"one triangle", mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}})},
      {"isolated vertices", mesh_of({{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}}, {{1, 2, 3}})},
      {"no area", mesh_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, {{0, 1, 2}, {1, 3, 2}})},
      {"one point", mesh_of({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {{0, 1, 2}})},
      {"a vertex twice", mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, 1}, {0, 1, 2}, {2, 2, 2}})},
      {"the same triangle thrice", mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 1, 2}, {2, 1, 0}})},
      {"three sheets on one edge",
       mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}})}};
  for (const auto& [name, mesh] : meshes) {
    const Curvatures found = curvature_of(mesh);
    ASSERT_EQ(found.rows(), mesh.triangles.rows()) << name;
    EXPECT_EQ(found.cwiseAbs().maxCoeff(), 0) << name;
  }
}

/// Splits a triangle at the middle of its side from `corner` and closes the gap by a triangle that has no area.
Mesh with_sliver(Mesh mesh, int triangle, int corner) {
  Eigen::RowVector3i corners = mesh.triangles.row(triangle);
  std::rotate(corners.begin(), corners.begin() + corner, corners.end());
  const auto middle = static_cast<int>(mesh.positions.rows());
  mesh.positions.conservativeResize(middle + 1, 3);
  mesh.positions.row(middle) = (mesh.positions.row(corners[0]) + mesh.positions.row(corners[1])) / 2;
  mesh.triangles.conservativeResize(mesh.triangles.rows() + 2, 3);
  mesh.triangles.bottomRows(2) << corners[0], corners[1], middle, middle, corners[1], corners[2];
  mesh.triangles(triangle, (corner + 1) % 3) = middle;
  return mesh;
}

TEST(CurvatureInput, ATriangleWithoutAreaDoesNotSmoothACrease) {
  Mesh prism = test::cylinder(1, 2, 9, 3);
  prism.positions *= Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix().transpose();
  for (int t = 0; t < prism.triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      EXPECT_LT(curvature_of(with_sliver(prism, t, k)).cwiseAbs().maxCoeff(), 1e-9) << "beside triangle " << t;
    }
  }
}

TEST(CurvatureInput, ATriangleWithoutAreaSpoilsOnlyWhatIsNearIt) {
  const Mesh ball = test::sphere(1, 3);
  const Curvatures found = curvature_of(with_sliver(ball, 100, 0)), clean = curvature_of(ball);
  EXPECT_LT(found.cwiseAbs().maxCoeff(), 2);
  const Eigen::ArrayXd changes = (found.topRows(clean.rows()) - clean).rowwise().norm().array();
  EXPECT_LT((changes > 1e-9).count(), 150);
  EXPECT_LT((changes > 0.1).count(), 20);
}

/// A square leaf of a book whose spine is the x axis, opened by an angle; wound the other way where `flipped`.
Mesh with_leaf(Mesh book, double angle, bool flipped) {
  Mesh leaf = test::sheet(6);
  leaf.positions *= Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()).toRotationMatrix().transpose();
  if (flipped) leaf.triangles.col(0).swap(leaf.triangles.col(1));
  const auto count = static_cast<int>(book.positions.rows());
  book = test::joined(book, leaf);
  for (int& v : book.triangles.reshaped()) {
    if (v >= count && v < count + 7) v -= count;  // The lowest row of each is the spine, the first leaf's.
  }
  return book;
}

TEST(CurvatureInput, LeavesOfABookAreFlatUnlessTheyContinueEachOther) {
  const double degree = std::acos(-1.0) / 180;
  const Mesh leaf = test::sheet(6);
  const Mesh open = with_leaf(leaf, 160 * degree, true);
  EXPECT_GT(curvature_of(open).maxCoeff(), 0.1) << "a smooth bend";
  EXPECT_LT(curvature_of(with_leaf(open, 270 * degree, false)).cwiseAbs().maxCoeff(), 1e-11) << "three leaves";
  EXPECT_LT(curvature_of(with_leaf(leaf, 20 * degree, false)).cwiseAbs().maxCoeff(), 1e-11) << "winding reversed";
}

TEST(CurvatureInput, RoundingDoesNotDecideAboutTheCreaseAngle) {
  // All edges of the tube have the same angle.
  const Mesh tube = test::cylinder(1, 2, 12, 5);
  const Curvatures found = curvature_of(tube),
                   limit = curvature_of(tube, {.crease_angle = std::acos(-1.0) * 150 / 180});
  EXPECT_LT(relative_difference(limit, found), 1e-9);
}

TEST(CurvatureInput, OfALargeFanIsQuick) {
  // Around the hub every vertex is within two edges of all others: taking them all would need 10^10 neighbours.
  const int count = 100000;
  Mesh mesh{Positions(count + 1, 3), Triangles(count, 3)};
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::acos(-1.0) * i / count;
    mesh.positions.row(i) << std::cos(angle), std::sin(angle), 0;
    mesh.triangles.row(i) << count, i, (i + 1) % count;
  }
  mesh.positions.row(count).setZero();
  EXPECT_LT(curvature_of(mesh).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(CurvatureInput, RefusesWhatItCannotUse) {
  Mesh mesh = test::sheet();
  EXPECT_THROW(curvature_of(mesh, {.rings = 0}), InvalidInput);
  EXPECT_THROW(curvature_of(mesh, {.crease_angle = std::nan("")}), InvalidInput);
  EXPECT_THROW(curvature_of(mesh, {.crease_angle = -1}), InvalidInput);
  EXPECT_NO_THROW(curvature_of(mesh, {.rings = 1000000000}));
  mesh.positions(3, 1) = std::nan("");
  EXPECT_THROW(curvature_of(mesh), InvalidInput);
  mesh = test::sheet();
  mesh.triangles(0, 0) = 1000;
  EXPECT_THROW(curvature_of(mesh), InvalidInput);
}

}  // namespace
}  // namespace swage
