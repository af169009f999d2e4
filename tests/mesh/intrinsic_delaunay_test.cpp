#include "intrinsic_delaunay.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "flat.h"
#include "laplacian_system.h"
#include "measures.h"
#include "shapes.h"
#include "spokes_and_rims.h"

namespace swage::test {
namespace {

using Eigen::Vector3d;

IntrinsicTriangles flipped(const Mesh& mesh) {
  return intrinsic_delaunay(mesh, edges_of(mesh.triangles), flat_triangles(mesh.positions, mesh.triangles));
}

/// Turned about the y axis the more, the higher: the same surface, if round about it, of slanted triangles.
Mesh twisted(Mesh mesh, double by) {
  for (auto p : mesh.positions.rowwise()) {
    p = (Eigen::AngleAxisd(by * p[1], Vector3d::UnitY()) * Vector3d(p.transpose())).transpose();
  }
  return mesh;
}

/// In its plane.
Mesh slanted(Mesh mesh, double by) {
  mesh.positions.col(0) += by * mesh.positions.col(1);
  return mesh;
}

std::vector<NamedMesh> twisted_meshes() {
  return {{"tube", twisted(cylinder(0.5, 4, 64, 3), 0.7)},
          {"twisted", twisted(sphere(1, 3), 4)},
          {"slanted", slanted(sheet(8), 6.3)},
          {"apart", joined(twisted(torus(1, 0.4, 24, 12), 3), slanted(sheet(5), 2.2))}};
}

class IntrinsicDelaunay : public testing::TestWithParam<NamedMesh> {};

/// Of the angle that faces side k, by its cosine.
double facing(const IntrinsicTriangles& of, Eigen::Index t, int k) {
  const double l = of.lengths(t, k), p = of.lengths(t, (k + 1) % 3), q = of.lengths(t, (k + 2) % 3);
  return std::acos(std::clamp((p * p + q * q - l * l) / (2 * p * q), -1.0, 1.0));
}

IntrinsicTriangles unflipped(const Mesh& mesh) {
  IntrinsicTriangles same{mesh.triangles, Positions(mesh.triangles.rows(), 3)};
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      same.lengths(t, k) =
          (mesh.positions.row(mesh.triangles(t, (k + 1) % 3)) - mesh.positions.row(mesh.triangles(t, k))).norm();
    }
  }
  return same;
}

Eigen::VectorXd total_angles(const IntrinsicTriangles& of, Eigen::Index vertex_count) {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(vertex_count);
  for (Eigen::Index t = 0; t < of.triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) sums[of.triangles(t, (k + 2) % 3)] += facing(of, t, k);
  }
  return sums;
}

double area(const IntrinsicTriangles& of) {
  double sum = 0;
  for (Eigen::Index t = 0; t < of.triangles.rows(); ++t) {
    sum += of.lengths(t, 1) * of.lengths(t, 2) * std::sin(facing(of, t, 0)) / 2;
  }
  return sum;
}

/// Of each edge the angles opposite, of those with two. Edges are told apart by their length, where two join the same.
std::map<std::tuple<int, int, long>, std::vector<double>> opposite(const IntrinsicTriangles& of) {
  std::map<std::tuple<int, int, long>, std::vector<double>> angles;
  for (Eigen::Index t = 0; t < of.triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(of.triangles(t, k), of.triangles(t, (k + 1) % 3));
      angles[{a, b, std::lround(of.lengths(t, k) * 1e7)}].push_back(facing(of, t, k));
    }
  }
  return angles;
}

TEST_P(IntrinsicDelaunay, HasNoAnglesAboveAStraightOneOppositeAnEdge) {
  const auto above = [](const IntrinsicTriangles& of) {
    int count = 0;
    for (const auto& [edge, angles] : opposite(of)) {
      if (angles.size() == 2 && angles[0] + angles[1] > std::numbers::pi + 1e-6) ++count;
    }
    return count;
  };
  EXPECT_GT(above(unflipped(GetParam().mesh)), 0);
  EXPECT_EQ(above(flipped(GetParam().mesh)), 0);
}

TEST_P(IntrinsicDelaunay, IsTheSameSurface) {
  const Mesh& mesh = GetParam().mesh;
  const IntrinsicTriangles before = unflipped(mesh), now = flipped(mesh);
  EXPECT_NEAR(area(before), area(now), 1e-6 * area(before));
  const Eigen::VectorXd angles = total_angles(before, mesh.positions.rows());
  EXPECT_LT((angles - total_angles(now, mesh.positions.rows())).cwiseAbs().maxCoeff(), 1e-5);
  size_t boundary = 0, boundary_now = 0;
  for (const auto& [edge, beside] : opposite(before)) boundary += beside.size() == 1 ? 1 : 0;
  for (const auto& [edge, beside] : opposite(now)) boundary_now += beside.size() == 1 ? 1 : 0;
  EXPECT_EQ(boundary, boundary_now);
}

TEST_P(IntrinsicDelaunay, HasALaplacianWithoutNegativeWeightsInside) {
  const Mesh& mesh = GetParam().mesh;
  const std::vector<char> is_flat = flat_triangles(mesh.positions, mesh.triangles);
  const auto [triangles, lengths] = flipped(mesh);
  const Elements elements = triangle_elements({mesh.positions, triangles}, half_cotangents(lengths, is_flat));
  const Eigen::MatrixXd laplacian = LaplacianSystem(elements.pairs).laplacian();
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(laplacian).eigenvalues()[0],
            -1e-10 * laplacian.diagonal().maxCoeff());
}

INSTANTIATE_TEST_SUITE_P(Any, IntrinsicDelaunay, testing::ValuesIn(twisted_meshes()),
                         [](const auto& instance) { return instance.param.name; });

TEST(IntrinsicDelaunay, LeavesADelaunayMeshAlone) {
  for (const Mesh& mesh : {sphere(1, 3), sheet(6), torus(1, 0.4, 24, 12)}) {
    EXPECT_EQ(flipped(mesh).triangles, mesh.triangles);
  }
}

TEST(IntrinsicDelaunay, HasLinesOfTheirTrueLengthInAConvexPlane) {
  const Mesh mesh = slanted(sheet(8), 6.3);
  const IntrinsicTriangles now = flipped(mesh);
  EXPECT_LT((now.lengths - unflipped({mesh.positions, now.triangles}).lengths).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(IntrinsicDelaunay, LinearFunctionsAreHarmonicInThePlane) {
  const Mesh mesh = slanted(sheet(8), 6.3);
  const auto [triangles, lengths] = flipped(mesh);
  const std::vector<char> is_flat(static_cast<size_t>(triangles.rows()), 0);
  const Elements elements = triangle_elements({mesh.positions, triangles}, half_cotangents(lengths, is_flat));
  const Positions residual = LaplacianSystem(elements.pairs).laplacian() * mesh.positions;
  for (Eigen::Index v = 0; v < residual.rows(); ++v) {
    const double x = mesh.positions(v, 0) - 6.3 * mesh.positions(v, 1), y = mesh.positions(v, 1);
    if (std::min({x, y, 1 - x, 1 - y}) < 1e-9) continue;
    EXPECT_LT(residual.row(v).norm(), 1e-9) << v;
  }
}

}  // namespace
}  // namespace swage::test
