#include "swage/scaffold.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <future>
#include <limits>
#include <set>
#include <vector>

#include "adjacency.h"
#include "distinct.h"
#include "places.h"
#include "scaffold_edges.h"
#include "shapes.h"
#include "swage/error.h"
#include "swage/mesh_io.h"
#include "tetrahedra.h"

namespace swage {
namespace {

class ScaffoldOf : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_tetgen()) GTEST_SKIP() << "built without TetGen";
  }
};

struct Shape {
  const char* name;
  Mesh mesh;
};

Mesh many_boxes() {
  Mesh all = test::box({0.3, 0.2, 0.4}, 1);
  const Mesh one = all;
  for (int i = 1; i < 50; ++i) {
    const Eigen::Vector3d place(i % 5, i / 5 % 5 + 0.1 * std::sin(0.7 * i), i / 25);
    all = test::joined(all, test::transformed(one, 0.5 + 0.01 * i, place));
  }
  return all;
}

std::vector<Shape> shapes() {
  const Mesh box = test::box({1, 1, 1}, 3), sphere = test::sphere(1, 2);
  return {{"two boxes", test::joined(box, test::transformed(box, 0.7, {2, 0.3, 0.1}))},
          {"boxes on each other", test::joined(box, test::transformed(box, 1, {1, 0, 0}))},
          {"nested spheres", test::joined(sphere, test::joined(test::transformed(sphere, 0.5, {0, 0, 0.1}),
                                                               test::transformed(sphere, 0.1, {0, 0, 0.1})))},
          {"a sheet beside a torus", test::joined(test::torus(), test::transformed(test::sheet(), 1, {1.6, 0, 0}))},
          {"a sheet", test::sheet()},
          {"fifty boxes", many_boxes()}};
}

Eigen::RowVector3d corner(const Scaffold& s, Eigen::Index t, int k) { return s.positions.row(s.tetrahedra(t, k)); }

double volume(const Scaffold& s, Eigen::Index t) {
  const Eigen::RowVector3d a = corner(s, t, 0);
  return (corner(s, t, 1) - a).cross(corner(s, t, 2) - a).dot(corner(s, t, 3) - a) / 6;
}

/// Each vertex as the coordinates it has, so that vertices at one place are one.
using Place = std::array<double, 3>;
using Face = std::array<Place, 3>;

Face face(const Positions& positions, std::array<int, 3> corners) {
  Face face{};
  for (size_t k = 0; k < 3; ++k) {
    for (int axis = 0; axis < 3; ++axis) face[k][static_cast<size_t>(axis)] = positions(corners[k], axis);
  }
  std::sort(face.begin(), face.end());
  return face;
}

std::set<Face> faces_of(const Scaffold& s) {
  std::set<Face> faces;
  for (const auto& t : s.tetrahedra.rowwise()) {
    for (int left_out = 0; left_out < 4; ++left_out) {
      faces.insert(face(s.positions, {t[(left_out + 1) % 4], t[(left_out + 2) % 4], t[(left_out + 3) % 4]}));
    }
  }
  return faces;
}

void expect_all_triangles(const Scaffold& s, const Mesh& mesh) {
  const std::set<Face> faces = faces_of(s);
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    const auto& corners = mesh.triangles.row(t);
    EXPECT_TRUE(faces.contains(face(mesh.positions, {corners[0], corners[1], corners[2]}))) << t;
  }
}

/// Ericson, Real-Time Collision Detection, 5.1.5, by brute force over barycentric regions: plane, else edges.
double distance_to_segment(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const double along = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (a + along * (b - a) - p).norm();
}

double distance(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                const Eigen::Vector3d& c) {
  const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
  const auto inside = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    return normal.cross(to - from).dot(p - from) >= 0;
  };
  if (inside(a, b) && inside(b, c) && inside(c, a)) return std::abs(normal.dot(p - a));
  return std::min({distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
}

double distance_to_surface(const Eigen::Vector3d& point, const Mesh& mesh) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh.triangles.rowwise()) {
    nearest = std::min(nearest,
                       distance(point, mesh.positions.row(t[0]), mesh.positions.row(t[1]), mesh.positions.row(t[2])));
  }
  return nearest;
}

void expect_is_a_scaffold(const Scaffold& s, const Mesh& mesh, double enlargement) {
  const Eigen::Index count = mesh.positions.rows();
  ASSERT_GE(s.positions.rows(), count + 8);
  EXPECT_EQ(s.positions.topRows(count), mesh.positions);
  const Eigen::RowVector3d low = s.positions.row(count), high = s.positions.row(count + 7);
  const Eigen::RowVector3d mesh_low = mesh.positions.colwise().minCoeff(),
                           mesh_high = mesh.positions.colwise().maxCoeff();
  const double longest = (mesh_high - mesh_low).maxCoeff(), room = (enlargement - 1) / 2 * longest;
  EXPECT_NEAR((mesh_low - low).minCoeff(), room, 1e-9 * longest);
  EXPECT_NEAR((high - mesh_high).minCoeff(), room, 1e-9 * longest);
  double sum = 0;
  for (Eigen::Index t = 0; t < s.tetrahedra.rows(); ++t) {
    EXPECT_GT(volume(s, t), 0) << t;
    sum += volume(s, t);
  }
  EXPECT_NEAR(sum, (high - low).prod(), 1e-9 * sum);
  expect_all_triangles(s, mesh);
  for (Eigen::Index v = count + 8; v < s.positions.rows(); ++v) {
    EXPECT_GT(distance_to_surface(s.positions.row(v), mesh), 1e-9 * longest) << v;
    EXPECT_TRUE((s.positions.row(v).array() > low.array()).all() && (s.positions.row(v).array() < high.array()).all());
  }
}

TEST_F(ScaffoldOf, FillsABoxAndKeepsEveryTriangle) {
  for (const auto& [name, mesh] : shapes()) {
    SCOPED_TRACE(name);
    expect_is_a_scaffold(scaffold(mesh.positions, mesh.triangles), mesh, 1.5);
  }
}

TEST_F(ScaffoldOf, QualityAddsPointsButNoneOnTheSurface) {
  Eigen::Index added = 0;
  for (const auto& [name, mesh] : shapes()) {
    SCOPED_TRACE(name);
    const Scaffold plain = scaffold(mesh.positions, mesh.triangles, {.enlargement = 2});
    const Scaffold fine = scaffold(mesh.positions, mesh.triangles, {.enlargement = 2, .quality = true});
    expect_is_a_scaffold(fine, mesh, 2);
    EXPECT_GE(fine.positions.rows(), plain.positions.rows());
    added += fine.positions.rows() - plain.positions.rows();
  }
  EXPECT_GT(added, 100);
}

TEST_F(ScaffoldOf, JoinsAllComponents) {
  for (const auto& [name, mesh] : shapes()) {
    SCOPED_TRACE(name);
    const Scaffold s = scaffold(mesh.positions, mesh.triangles);
    const auto count = static_cast<int>(mesh.positions.rows());
    const std::vector<int> component = components(mesh.triangles, count);
    std::vector<std::array<int, 3>> links;
    for (const auto& [a, b] : scaffold_edges(s.tetrahedra, component)) {
      if (b < count) links.push_back({component[static_cast<size_t>(a)], component[static_cast<size_t>(b)], 0});
    }
    Triangles linked(static_cast<Eigen::Index>(links.size()), 3);
    for (size_t i = 0; i < links.size(); ++i) {
      linked.row(static_cast<Eigen::Index>(i)) << links[i][0], links[i][1], links[i][1];
    }
    const int component_count = *std::max_element(component.begin(), component.end()) + 1;
    for (int group : components(linked, component_count)) EXPECT_EQ(group, 0);
  }
}

TEST_F(ScaffoldOf, TheSameMeshGivesTheSameBytes) {
  for (const auto& [name, mesh] : shapes()) {
    SCOPED_TRACE(name);
    const Scaffold once = scaffold(mesh.positions, mesh.triangles), again = scaffold(mesh.positions, mesh.triangles);
    EXPECT_EQ(once.positions, again.positions);
    EXPECT_EQ(once.tetrahedra, again.tetrahedra);
  }
}

TEST_F(ScaffoldOf, SizeAndPlaceDoNotMatter) {
  const Mesh mesh = shapes()[0].mesh;
  const Scaffold plain = scaffold(mesh.positions, mesh.triangles);
  for (const double size : {std::ldexp(1, -300), std::ldexp(1, 30)}) {
    const Mesh other = test::transformed(mesh, size, {0, 0, 0});
    EXPECT_EQ(scaffold(other.positions, other.triangles).tetrahedra, plain.tetrahedra) << size;
  }
  const Mesh far = test::transformed(mesh, 1e-3, {1000, -2000, 500});
  expect_is_a_scaffold(scaffold(far.positions, far.triangles), far, 1.5);
}

/// Points of a torus lie on spheres: order and last digits would decide what tetrahedra there are.
TEST_F(ScaffoldOf, OrderAndLastDigitsDoNotMatter) {
  const Mesh mesh = test::joined(test::torus(1, 0.4, 16, 8), test::transformed(test::box(), 1, {2, 0, 0}));
  Mesh other{mesh.positions.colwise().reverse() * (1 + 1e-15), mesh.triangles.colwise().reverse()};
  const auto last = static_cast<int>(mesh.positions.rows()) - 1;
  other.triangles = (last - other.triangles.array()).matrix();
  const auto linked = [&](const Mesh& of, bool reversed) {
    const Scaffold s = scaffold(of.positions, of.triangles);
    std::set<std::array<int, 4>> all;
    for (const auto& t : s.tetrahedra.rowwise()) {
      std::array<int, 4> corners{t[0], t[1], t[2], t[3]};
      for (int& v : corners) v = reversed && v <= last ? last - v : v;
      std::sort(corners.begin(), corners.end());
      all.insert(corners);
    }
    return all;
  };
  EXPECT_EQ(linked(mesh, false), linked(other, true));
}

/// Crossing surfaces too, whose triangles could not all be faces.
TEST_F(ScaffoldOf, VerticesAlone) {
  const Mesh box = test::box({1, 1, 1}, 3);
  const Mesh both = test::joined(box, test::transformed(box, 1, {0.43, 0.31, 0.17}));
  EXPECT_THROW(scaffold(both.positions, both.triangles), Unsolvable);
  ScaffoldOptions options;
  options.faces = false;
  const Scaffold all = scaffold(both.positions, both.triangles, options);
  EXPECT_EQ(static_cast<Eigen::Index>(all.left_out.size()), both.triangles.rows());
  std::set<int> corners(all.tetrahedra.data(), all.tetrahedra.data() + all.tetrahedra.size());
  for (int v = 0; v < both.positions.rows(); ++v) EXPECT_TRUE(corners.contains(v)) << v;
}

TEST_F(ScaffoldOf, SeveralAtOnceOfAllSizes) {
  std::vector<std::future<void>> threads;
  for (int thread = 0; thread < 4; ++thread) {
    threads.push_back(std::async(std::launch::async, [thread] {
      const Mesh mesh =
          test::transformed(shapes()[static_cast<size_t>(thread)].mesh, std::pow(1000, thread - 2), {0, 0, 0});
      const Scaffold first = scaffold(mesh.positions, mesh.triangles);
      expect_is_a_scaffold(first, mesh, 1.5);
      for (int i = 0; i < 5; ++i) EXPECT_EQ(scaffold(mesh.positions, mesh.triangles).tetrahedra, first.tetrahedra);
    }));
  }
  for (auto& thread : threads) thread.get();
}

TEST_F(ScaffoldOf, WhatIsTwiceOrFlatOrLooseIsLeftOut) {
  const Mesh box = test::box({1, 1, 1}, 2);
  Mesh mesh = test::joined(box, box);  // All vertices and triangles twice.
  const Eigen::Index count = mesh.positions.rows(), triangles = mesh.triangles.rows();
  mesh.positions.conservativeResize(count + 2, 3);
  mesh.positions.row(count) << 0.1, 0.2, 0;  // On a face, of a flat triangle.
  mesh.positions.row(count + 1) << 5, 0, 0;  // Of none.
  mesh.triangles.conservativeResize(triangles + 2, 3);
  mesh.triangles.row(triangles) << 0, static_cast<int>(count), static_cast<int>(count);
  mesh.triangles.row(triangles + 1) << 1, 0, 1;

  const Scaffold s = scaffold(mesh.positions, mesh.triangles);
  EXPECT_EQ(s.positions.topRows(count + 2), mesh.positions);
  expect_all_triangles(s, box);
  for (int v : s.tetrahedra.reshaped()) EXPECT_TRUE(v < box.positions.rows() || v >= count + 2) << v;
}

/// The distinct triangles but those left out.
Mesh without(const Mesh& mesh, const std::vector<int>& left_out) {
  std::vector<int> kept;
  for (int t : distinct(mesh.positions, mesh.triangles).originals) {
    if (!std::binary_search(left_out.begin(), left_out.end(), t)) kept.push_back(t);
  }
  return {mesh.positions, mesh.triangles(kept, Eigen::all)};
}

/// Of the corpus' models of several components each gets a scaffold or a message: all those that cross themselves
/// nowhere get one, and most others where crossing triangles may be left out.
TEST_F(ScaffoldOf, RealModelsOfManyComponents) {
  if (!test::has_shared()) GTEST_SKIP() << "no real meshes here";
  int made = 0, made_of_a_part = 0, refused = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test::shared("data/meshes/C_multi_component"))) {
    if (entry.path().extension() == ".mtl" || entry.path().stem() == "soup") continue;  // 20 s to a message.
    SCOPED_TRACE(entry.path().filename());
    const Mesh mesh = read_mesh(entry.path()).mesh;
    try {
      const Scaffold s = scaffold(mesh.positions, mesh.triangles, {.leave_out_crossing = true});
      expect_all_triangles(s, without(mesh, s.left_out));
      ++(s.left_out.empty() ? made : made_of_a_part);
    } catch (const Unsolvable&) {
      ++refused;
    }
  }
  EXPECT_GE(made, 8);
  EXPECT_GE(made_of_a_part, 20);
  EXPECT_EQ(made + made_of_a_part + refused, 34);
}

}  // namespace
}  // namespace swage
