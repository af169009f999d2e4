#include "decimate.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "adjacency.h"
#include "measures.h"
#include "shapes.h"

namespace swage {
namespace {

void expect_closed(const Mesh& mesh, Eigen::Index euler) {
  const Edges edges = edges_of(mesh.triangles);
  for (int e = 0; e < edges.triangles.size(); ++e) {
    const auto beside = edges.triangles[e];
    ASSERT_EQ(beside.size(), 2);
    int forward = 0;
    for (int t : beside) {
      for (int k = 0; k < 3; ++k)
        forward += edges.triangle_edges(t, k) == e && mesh.triangles(t, k) == edges.vertices(e, 0);
    }
    EXPECT_EQ(forward, 1);
  }
  EXPECT_EQ(mesh.positions.rows() - edges.vertices.rows() + mesh.triangles.rows(), euler);
  const Lists around = triangles_of_vertices(mesh.triangles, static_cast<int>(mesh.positions.rows()));
  for (int v = 0; v < around.size(); ++v) EXPECT_GE(around[v].size(), 3);
}

/// Height over longest side of the worst triangle.
double slimmest(const Mesh& mesh) {
  double worst = 1;
  const Positions areas = area_vectors(mesh.positions, mesh.triangles);
  for (Eigen::Index t = 0; t < areas.rows(); ++t) {
    double longest = 0;
    for (int k = 0; k < 3; ++k) {
      const auto &from = mesh.positions.row(mesh.triangles(t, k)),
                 &to = mesh.positions.row(mesh.triangles(t, (k + 1) % 3));
      longest = std::max(longest, (to - from).squaredNorm());
    }
    worst = std::min(worst, areas.row(t).norm() / longest);
  }
  return worst;
}

struct Case {
  const char* name;
  Mesh mesh;
  int target;
  int euler;
};

std::vector<Case> cases() {
  return {{"sphere", test::sphere(1, 4), 400, 2},
          {"torus", test::torus(), 400, 0},
          {"box", test::box({3, 1, 0.2}, 8), 100, 2},
          {"cylinder", test::cylinder(0.5, 4, 32, 40), 300, 2}};
}

TEST(Decimate, LeavesAClosedSurfaceOfTheSameTopologyWithoutNeedles) {
  for (const auto& [name, mesh, target, euler] : cases()) {
    SCOPED_TRACE(name);
    const Proxy proxy = decimate(mesh, target, {});
    EXPECT_GE(proxy.mesh.triangles.rows(), target);
    EXPECT_LE(proxy.mesh.triangles.rows(), target + 1);
    expect_closed(proxy.mesh, euler);
    EXPECT_GT(slimmest(proxy.mesh), 0.02);
    EXPECT_NEAR(test::volume(proxy.mesh), test::volume(mesh), 0.05 * test::volume(mesh));
  }
}

TEST(Decimate, GoesNoFurtherThanAClosedSurface) {
  for (const auto& [name, mesh, target, euler] : cases()) {
    SCOPED_TRACE(name);
    const Proxy proxy = decimate(mesh, 0, {});
    EXPECT_GE(proxy.mesh.triangles.rows(), 4);
    EXPECT_LT(proxy.mesh.triangles.rows(), target);
    expect_closed(proxy.mesh, euler);
    EXPECT_GT(slimmest(proxy.mesh), 1e-4);
    EXPECT_GT(test::volume(proxy.mesh), 0.05 * test::volume(mesh));
  }
}

TEST(Decimate, VerticesAreTheOriginals) {
  for (const auto& [name, mesh, target, euler] : cases()) {
    SCOPED_TRACE(name);
    const Proxy proxy = decimate(mesh, target, {});
    EXPECT_EQ(proxy.mesh.positions, mesh.positions(proxy.vertices, Eigen::all));
    ASSERT_EQ(proxy.vertex_of.size(), static_cast<size_t>(mesh.positions.rows()));
    for (size_t i = 0; i < proxy.vertices.size(); ++i) {
      EXPECT_EQ(proxy.vertex_of[static_cast<size_t>(proxy.vertices[i])], static_cast<int>(i));
    }
    for (int v : proxy.vertex_of) EXPECT_TRUE(v >= 0 && v < static_cast<int>(proxy.vertices.size()));
  }
}

TEST(Decimate, EachTriangleHasAStandInThatFacesItsWay) {
  for (const auto& [name, mesh, target, euler] : cases()) {
    SCOPED_TRACE(name);
    const Proxy proxy = decimate(mesh, target, {});
    ASSERT_EQ(proxy.triangle_of.size(), static_cast<size_t>(mesh.triangles.rows()));
    const Positions normals = unit_normals(mesh.positions, mesh.triangles);
    const Positions proxy_normals = unit_normals(proxy.mesh.positions, proxy.mesh.triangles);
    std::vector<int> stands_for(static_cast<size_t>(proxy.mesh.triangles.rows()), 0);
    Eigen::Index alike = 0;
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
      const int stand_in = proxy.triangle_of[static_cast<size_t>(t)];
      ++stands_for.at(static_cast<size_t>(stand_in));
      alike += normals.row(t).dot(proxy_normals.row(stand_in)) > std::sqrt(0.5);
    }
    EXPECT_GT(*std::min_element(stands_for.begin(), stands_for.end()), 0);
    EXPECT_GT(static_cast<double>(alike), 0.95 * static_cast<double>(mesh.triangles.rows()));
  }
}

TEST(Decimate, KeepsTheVerticesNamed) {
  const std::vector<int> kept{3, 40, 41, 500, 2000};
  const Proxy proxy = decimate(test::sphere(1, 4), 100, kept);
  for (int v : kept) EXPECT_TRUE(std::binary_search(proxy.vertices.begin(), proxy.vertices.end(), v)) << v;
}

TEST(Decimate, BothOfTwoComponentsSurvive) {
  const Mesh mesh = test::joined(test::sphere(1, 4), test::transformed(test::sphere(1, 2), 0.001, {3, 0, 0}));
  const Proxy proxy = decimate(mesh, 100, {});
  const auto component = components(proxy.mesh.triangles, static_cast<int>(proxy.mesh.positions.rows()));
  EXPECT_EQ(*std::max_element(component.begin(), component.end()), 1);
  expect_closed(proxy.mesh, 4);
  const int sphere_vertices = static_cast<int>(test::sphere(1, 4).positions.rows());
  for (size_t i = 0; i < proxy.vertices.size(); ++i) {
    EXPECT_EQ(component[i], proxy.vertices[i] >= sphere_vertices ? 1 : 0);
  }
}

TEST(Decimate, KeepsTheCornersAndEdgesOfABox) {
  for (const Eigen::Vector3d& size : {Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(3, 1, 0.1)}) {
    const Mesh mesh = test::box(size, 12);
    const Proxy proxy = decimate(mesh, 120, {});
    EXPECT_EQ(proxy.mesh.triangles.rows(), 120);
    EXPECT_NEAR(test::volume(proxy.mesh), size.prod(), 1e-9);
    EXPECT_NEAR(area_vectors(proxy.mesh.positions, proxy.mesh.triangles).rowwise().norm().sum() / 2,
                2 * (size[0] * size[1] + size[1] * size[2] + size[2] * size[0]), 1e-9);
  }
}

TEST(Decimate, AThinPlateStaysAPlate) {
  const Proxy proxy = decimate(test::box({1, 1, 0.001}, 10), 0, {});
  expect_closed(proxy.mesh, 2);
  EXPECT_GT(test::volume(proxy.mesh), 1e-4);
}

TEST(Decimate, LeavesBoundariesAlone) {
  const Mesh mesh = test::sheet(10);
  const Proxy proxy = decimate(mesh, 0, {});
  EXPECT_LT(proxy.mesh.triangles.rows(), mesh.triangles.rows() / 2);
  EXPECT_NEAR(area_vectors(proxy.mesh.positions, proxy.mesh.triangles).rowwise().norm().sum() / 2, 1, 1e-12);
  for (int v = 0; v <= 10; ++v) EXPECT_TRUE(std::binary_search(proxy.vertices.begin(), proxy.vertices.end(), v));
}

TEST(Decimate, AVertexOfManySidesIsNoBottleneck) {
  const int sides = 20000;
  Mesh mesh{Positions(sides + 2, 3), Triangles(2 * sides, 3)};
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    mesh.positions.row(i) << std::cos(angle), std::sin(angle), 0;
    mesh.triangles.row(i) << i, (i + 1) % sides, sides;
    mesh.triangles.row(sides + i) << (i + 1) % sides, i, sides + 1;
  }
  mesh.positions.bottomRows(2) << 0, 0, 1, 0, 0, -1;
  const Proxy proxy = decimate(mesh, 100, {});
  EXPECT_EQ(proxy.mesh.triangles.rows(), 100);
  expect_closed(proxy.mesh, 2);
  EXPECT_NEAR(test::volume(proxy.mesh), test::volume(mesh), 0.02 * test::volume(mesh));
}

TEST(Decimate, IsDeterministic) {
  const Mesh mesh = test::torus();
  const Proxy once = decimate(mesh, 500, {7}), again = decimate(mesh, 500, {7});
  EXPECT_EQ(once.mesh.triangles, again.mesh.triangles);
  EXPECT_EQ(once.vertices, again.vertices);
  EXPECT_EQ(once.vertex_of, again.vertex_of);
  EXPECT_EQ(once.triangle_of, again.triangle_of);
}

TEST(Decimate, AsManyTrianglesAsThereAreIsTheMeshItself) {
  const Mesh mesh = test::sphere(1, 1);
  for (int target : {80, 1000}) {
    const Proxy proxy = decimate(mesh, target, {});
    EXPECT_EQ(proxy.mesh.positions, mesh.positions);
    EXPECT_EQ(proxy.mesh.triangles, mesh.triangles);
    EXPECT_EQ(proxy.vertices, proxy.vertex_of);
    EXPECT_EQ(proxy.vertices.size(), 42u);
    EXPECT_EQ(proxy.triangle_of.size(), 80u);
  }
}

TEST(Decimate, AsksWhetherToGoOn) {
  double last = -1;
  bool is_ascending = true;
  const auto watch = [&](double part) {
    is_ascending = is_ascending && part >= last && part <= 1;
    last = part;
    return true;
  };
  EXPECT_GT(decimate(test::sphere(1, 5), 100, {}, watch).mesh.triangles.rows(), 0);
  EXPECT_TRUE(is_ascending);
  EXPECT_GE(last, 0);

  for (int allowed : {0, 1, 2}) {
    int asked = 0;
    const Proxy none = decimate(test::sphere(1, 6), 100, {}, [&](double) { return asked++ < allowed; });
    EXPECT_EQ(asked, allowed + 1);
    EXPECT_EQ(none.mesh.triangles.rows(), 0);
    EXPECT_TRUE(none.vertex_of.empty());
  }
}

}  // namespace
}  // namespace swage
