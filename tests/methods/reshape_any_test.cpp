// Meshes that are not one closed, connected, well-made surface.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "adjacency.h"
#include "edit_measures.h"
#include "measures.h"
#include "shapes.h"
#include "swage/reshape.h"

namespace swage {
namespace {

using testing::Contains;
using testing::HasSubstr;

/// Stretches along an axis by `by` of the mesh's extent: what lies in the lowest tenth stays, what lies in the highest
/// goes along.
Gesture stretch(const Mesh& mesh, int axis = 1, double by = 0.3) {
  const double low = mesh.positions.col(axis).minCoeff(), extent = mesh.positions.col(axis).maxCoeff() - low;
  Gesture gesture;
  for (int v = 0; v < mesh.positions.rows(); ++v) {
    const double part = (mesh.positions(v, axis) - low) / extent;
    Eigen::Vector3d target = mesh.positions.row(v);
    if (part > 0.1 && part < 0.9) continue;
    if (part >= 0.9) target[axis] += by * extent;
    gesture.add(v, target);
  }
  return gesture;
}

ReshapeResult reshaped(const Mesh& mesh, const Gesture& gesture) {
  return reshape(mesh.positions, mesh.triangles, gesture);
}

/// Mean distance from the result of the mesh itself, in diagonals. Its vertices are the first of the other's.
double off(const Mesh& mesh, const Mesh& other) {
  const Positions one = reshaped(mesh, stretch(mesh)).positions;
  const Positions two = reshaped(other, stretch(other)).positions;
  return (two.topRows(one.rows()) - one).rowwise().norm().mean() / box_diagonal(mesh.positions);
}

/// Triangles that `cuts` get vertices of their own.
template <typename Cuts>
Mesh cut(const Mesh& mesh, const Cuts& cuts) {
  Mesh result = mesh;
  std::vector<int> copies(static_cast<size_t>(mesh.positions.rows()), -1);
  for (int t = 0; t < mesh.triangles.rows(); ++t) {
    if (!cuts(t)) continue;
    for (int k = 0; k < 3; ++k) {
      int& copy = copies[static_cast<size_t>(mesh.triangles(t, k))];
      if (copy < 0) {
        copy = static_cast<int>(result.positions.rows());
        result.positions.conservativeResize(copy + 1, 3);
        result.positions.row(copy) = mesh.positions.row(mesh.triangles(t, k));
      }
      result.triangles(t, k) = copy;
    }
  }
  return result;
}

TEST(ReshapeAny, AMeshCutIntoComponentsThatTouchIsReshapedLikeTheUncutOne) {
  const Mesh mesh = test::cylinder();
  const Mesh halves = cut(mesh, [&](int t) { return mesh.positions(mesh.triangles(t, 0), 1) > 0.45; });
  ASSERT_GT(halves.positions.rows(), mesh.positions.rows());
  EXPECT_LT(off(mesh, halves), 1e-4);
}

TEST(ReshapeAny, OfASeamOrADoubledFaceNothingIsSeen) {
  const Mesh mesh = test::torus();
  EXPECT_LT(off(mesh, cut(mesh, [](int t) { return t < 40; })), 1e-4);
  Mesh doubled = mesh;
  doubled.triangles.conservativeResize(mesh.triangles.rows() + 2, 3);
  doubled.triangles.bottomRows(2) = mesh.triangles.middleRows(7, 2).rowwise().reverse();
  EXPECT_LT(off(mesh, doubled), 1e-4);
}

TEST(ReshapeAny, WhichWayTrianglesWindDoesNotMatter) {
  const Mesh mesh = test::cylinder();
  Mesh turned = mesh;
  for (int t = 0; t < turned.triangles.rows(); t += 3) std::swap(turned.triangles(t, 0), turned.triangles(t, 2));
  EXPECT_LT(off(mesh, turned), 1e-6);
  EXPECT_THAT(reshaped(turned, stretch(turned)).report.warnings, Contains(HasSubstr("wind against")));
}

TEST(ReshapeAny, AnOpenSurfaceKeepsItsNormals) {
  Mesh mesh = test::cylinder(0.5, 1, 32, 10);
  const double top = mesh.positions.col(1).maxCoeff();
  Triangles open(mesh.triangles.rows(), 3);
  Eigen::Index count = 0;
  for (const auto& t : mesh.triangles.rowwise()) {
    const bool cap = mesh.positions(t[0], 1) == top && mesh.positions(t[1], 1) == top && mesh.positions(t[2], 1) == top;
    if (!cap) open.row(count++) = t;
  }
  mesh.triangles = open.topRows(count);
  const Gesture gesture = stretch(mesh);
  const ReshapeResult result = reshaped(mesh, gesture);
  EXPECT_LT(test::mean_normal_change(mesh, result.positions), 1.0);
  EXPECT_LT(test::handle_error(mesh, gesture, result.positions), 0.005);
  EXPECT_THAT(result.report.warnings, Contains(HasSubstr("edges have one triangle")));
}

TEST(ReshapeAny, AWallInsideABoxGoesWithIt) {
  // A box with a wall across its middle: edges of three triangles all round.
  const Mesh box = test::box({2, 1, 1}, 4);
  Mesh wall = test::sheet(4);  // z = 0; turned so that it stands at x = 1.
  for (auto row : wall.positions.rowwise()) row = Eigen::RowVector3d(1, row[0], row[1]).eval();
  const Mesh mesh = test::joined(box, wall);
  const Gesture gesture = stretch(mesh, 0);
  const ReshapeResult result = reshaped(mesh, gesture);
  EXPECT_THAT(result.report.warnings, Contains(HasSubstr("more than two triangles")));
  EXPECT_LT(test::mean_normal_change(mesh, result.positions), 1.0);
  const Positions moved = result.positions.bottomRows(wall.positions.rows());
  EXPECT_NEAR(moved.col(0).mean(), 1.3, 0.05);
  EXPECT_LT(moved.col(0).maxCoeff() - moved.col(0).minCoeff(), 0.02);
}

TEST(ReshapeAny, AMoebiusStripHasNoTwoSides) {
  constexpr int kAround = 60, kAcross = 4;
  Mesh mesh{Positions(kAround * (kAcross + 1), 3), Triangles(2 * kAround * kAcross, 3)};
  const auto at = [&](int i, int j) {
    return i < kAround ? i * (kAcross + 1) + j : (i - kAround) * (kAcross + 1) + kAcross - j;
  };
  for (int i = 0; i < kAround; ++i) {
    const double a = 2 * M_PI * i / kAround;
    for (int j = 0; j <= kAcross; ++j) {
      const double s = 0.4 * (j / double(kAcross) - 0.5), r = 1 + s * std::cos(a / 2);
      mesh.positions.row(at(i, j)) << r * std::cos(a), r * std::sin(a), s * std::sin(a / 2);
      if (j == kAcross) continue;
      mesh.triangles.row(2 * (i * kAcross + j)) << at(i, j), at(i + 1, j), at(i + 1, j + 1);
      mesh.triangles.row(2 * (i * kAcross + j) + 1) << at(i, j), at(i + 1, j + 1), at(i, j + 1);
    }
  }
  const Gesture gesture = stretch(mesh, 0, 0.2);
  const ReshapeResult result = reshaped(mesh, gesture);
  EXPECT_LT(test::handle_error(mesh, gesture, result.positions), 0.01);
  EXPECT_LT(test::mean_normal_change(mesh, result.positions), 5);
}

TEST(ReshapeAny, ATriangleWithoutAreaClosesItsGap) {
  // A vertex is set on the middle of an edge, seen from one side only; a flat triangle is between.
  const Mesh mesh = test::cylinder();
  Mesh capped = mesh;
  const Edges edges = edges_of(mesh.triangles);
  const int e = 100, t = edges.triangles[e][0];
  const auto middle = static_cast<int>(mesh.positions.rows());
  const int a = edges.vertices(e, 0), b = edges.vertices(e, 1);
  capped.positions.conservativeResize(middle + 1, 3);
  capped.positions.row(middle) = (mesh.positions.row(a) + mesh.positions.row(b)) / 2;
  capped.triangles.conservativeResize(mesh.triangles.rows() + 2, 3);
  Eigen::RowVector3i first = mesh.triangles.row(t), second = first;
  for (int k = 0; k < 3; ++k) {
    if (first[k] == a) first[k] = middle;
    if (second[k] == b) second[k] = middle;
  }
  capped.triangles.row(t) = first;
  capped.triangles.row(mesh.triangles.rows()) = second;
  const bool forward = runs_along(mesh.triangles, t, edges.vertices.row(e));
  capped.triangles.bottomRows(1) << (forward ? a : b), (forward ? b : a), middle;
  EXPECT_LT(off(mesh, capped), 2e-3);
  const ReshapeResult result = reshaped(capped, stretch(capped));
  EXPECT_THAT(result.report.warnings, Contains(HasSubstr("1 triangle has no area")));
  const Eigen::RowVector3d between = (result.positions.row(a) + result.positions.row(b)) / 2;
  EXPECT_LT((result.positions.row(middle) - between).norm(), 0.01);
}

TEST(ReshapeAny, AVertexWithoutATriangleGoesWithTheSurface) {
  const Mesh box = test::box({1, 1, 1}, 4);
  Mesh mesh = box;
  const auto lone = static_cast<int>(box.positions.rows());
  mesh.positions.conservativeResize(lone + 1, 3);
  mesh.positions.row(lone) << 1.05, 0.95, 0.5;  // Beside the top.
  const Gesture gesture = stretch(box);
  const ReshapeResult result = reshaped(mesh, gesture);
  EXPECT_LT((result.positions.row(lone) - Eigen::RowVector3d(1.05, 1.25, 0.5)).norm(), 0.02);
  EXPECT_LT((result.positions.topRows(lone) - reshaped(box, gesture).positions).rowwise().norm().maxCoeff(), 1e-9);
  Gesture asked = gesture;
  asked.add(lone, {3, 2, 1});
  EXPECT_EQ(reshaped(mesh, asked).positions.row(lone), Eigen::RowVector3d(3, 2, 1));
}

TEST(ReshapeAny, ComponentsApartGoTogether) {
  const Mesh box = test::box({1, 1, 1}, 4);
  const Mesh mesh = test::joined(box, test::transformed(box, 0.5, {1.2, 0.25, 0.25}));
  Gesture gesture;
  for (int v = 0; v < box.positions.rows(); ++v) gesture.add(v, box.positions.row(v) + Eigen::RowVector3d(0, 2, 0));
  const ReshapeResult result = reshaped(mesh, gesture);
  const Positions second = (result.positions - mesh.positions).bottomRows(box.positions.rows());
  EXPECT_LT((second.rowwise() - Eigen::RowVector3d(0, 2, 0)).rowwise().norm().maxCoeff(), 0.05);
  EXPECT_THAT(result.report.paths.at("components"), HasSubstr("2 components"));
}

TEST(ReshapeAny, ComponentsThatTouchStayInTouch) {
  // A box stands on a table of two triangles, away from their vertices.
  const Mesh table = test::transformed(test::sheet(1), 4, {0, 0, 0});
  const Mesh mesh = test::joined(table, test::transformed(test::box({1, 1, 1}, 3), 1, {1.6, 1.2, 0}));
  Gesture gesture;
  for (int v = 0; v < 4; ++v) gesture.add(v, mesh.positions.row(v) + Eigen::RowVector3d(0, 0, 1));
  const Positions result = reshaped(mesh, gesture).positions;
  EXPECT_LT(
      (result - mesh.positions - Eigen::RowVector3d(0, 0, 1).replicate(result.rows(), 1)).rowwise().norm().maxCoeff(),
      0.02);
}

TEST(ReshapeAny, ComponentsThatCrossStayTogether) {
  // A rod through a wall.
  const Mesh wall = test::transformed(test::box({2, 2, 0.2}, 6), 1, {0, 0, 0});
  const Mesh rod = test::transformed(test::box({0.2, 0.2, 3}, 5), 1, {0.9, 0.9, -1.4});
  const Mesh mesh = test::joined(wall, rod);
  Gesture gesture;
  for (int v = 0; v < wall.positions.rows(); ++v) gesture.add(v, wall.positions.row(v) + Eigen::RowVector3d(1, 0, 0));
  const ReshapeResult result = reshaped(mesh, gesture);
  const Positions moved = (result.positions - mesh.positions).bottomRows(rod.positions.rows());
  EXPECT_LT((moved.rowwise() - Eigen::RowVector3d(1, 0, 0)).rowwise().norm().maxCoeff(), 0.05);
}

TEST(ReshapeAny, HandlesOnlyOnVerticesWithoutATriangleMoveTheSurfaceThere) {
  Mesh mesh = test::box({1, 1, 1}, 2);
  const auto lone = static_cast<int>(mesh.positions.rows());
  mesh.positions.conservativeResize(lone + 1, 3);
  mesh.positions.row(lone) << 2, 2, 2;
  Gesture gesture;
  gesture.add(lone, {3, 3, 3});
  const Positions moved = reshaped(mesh, gesture).positions - mesh.positions;
  EXPECT_LT((moved.rowwise() - Eigen::RowVector3d(1, 1, 1)).rowwise().norm().maxCoeff(), 0.05);
}

TEST(ReshapeAny, HandlesThatMissAreToldOf) {
  const Mesh mesh = test::box({1, 1, 1}, 4);
  Gesture torn;  // Two neighbours, to opposite sides.
  torn.add(0, mesh.positions.row(0) + Eigen::RowVector3d(0, 3, 0));
  const Edges edges = edges_of(mesh.triangles);
  torn.add(edges.vertices(0, 1), mesh.positions.row(edges.vertices(0, 1)) - Eigen::RowVector3d(0, 3, 0));
  ReshapeOptions options;
  options.finalise = false;
  options.weights.emplace().handle = 1;
  const ReshapeResult result = reshape(mesh.positions, mesh.triangles, torn, options);
  ASSERT_GT(test::handle_error(mesh, torn, result.positions), 0.01);
  EXPECT_THAT(result.report.warnings, Contains(HasSubstr("missed by more than 1 %")));
}

}  // namespace
}  // namespace swage
