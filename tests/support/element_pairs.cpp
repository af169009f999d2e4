#include "element_pairs.h"

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <set>
#include <utility>

#include "adjacency.h"
#include "shapes.h"

namespace swage::test {
namespace {

using Eigen::Index;
using Pair = std::pair<int, int>;

PairsRest pairs_rest_of(const Mesh& mesh, const std::vector<std::vector<Pair>>& elements) {
  PairsRest rest;
  rest.vertices = mesh.positions;
  rest.offsets = {0};
  for (const auto& pairs : elements) rest.offsets.push_back(rest.offsets.back() + static_cast<int>(pairs.size()));
  rest.pairs.resize(rest.offsets.back(), 2);
  int p = 0;
  for (const auto& pairs : elements) {
    for (const auto& [first, second] : pairs) rest.pairs.row(p++) << first, second;
  }
  rest.weights.setOnes(p);
  return rest;
}

/// Turned, bent and shaken.
Positions shaken(const Positions& positions, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Positions bent = positions * turn.transpose() + 0.2 * size * (3 / size * positions).array().sin().matrix();
  return bent + Positions::NullaryExpr(positions.rows(), 3, [&] { return 0.01 * size * normal(random); });
}

Mesh stretched_mesh(Mesh mesh, const Eigen::Vector3d& factors) {
  mesh.positions = mesh.positions * factors.asDiagonal();
  return mesh;
}

PairsCase moved_case(const std::string& name, const PairsRest& rest, double size = 1) {
  return {name, rest, shaken(rest.vertices, size, 1), unit_vectors(rest.normals.rows(), 2)};
}

}  // namespace

Positions unit_vectors(Index count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  return Positions::NullaryExpr(count, 3, [&] { return normal(random); }).eval().rowwise().normalized();
}

PairsRest vertex_pairs(const Mesh& mesh) {
  std::vector<std::vector<Pair>> elements(static_cast<size_t>(mesh.positions.rows()));
  std::set<Pair> edges;
  for (const auto& triangle : mesh.triangles.rowwise()) {
    for (int k = 0; k < 3; ++k) {
      edges.insert({triangle[k], triangle[(k + 1) % 3]});
      edges.insert({triangle[(k + 1) % 3], triangle[k]});
    }
  }
  for (const Pair& edge : edges) elements[static_cast<size_t>(edge.first)].push_back(edge);
  return pairs_rest_of(mesh, elements);
}

PairsRest triangle_pairs(const Mesh& mesh) {
  std::vector<std::vector<Pair>> elements;
  for (const auto& t : mesh.triangles.rowwise()) elements.push_back({{t[0], t[1]}, {t[1], t[2]}, {t[2], t[0]}});
  return pairs_rest_of(mesh, elements);
}

PairsRest tetrahedron_pairs(const Mesh& mesh) {
  Mesh with_centre = mesh;
  const int centre = static_cast<int>(mesh.positions.rows());
  with_centre.positions.conservativeResize(centre + 1, 3);
  with_centre.positions.row(centre) = mesh.positions.colwise().mean();
  std::vector<std::vector<Pair>> elements;
  for (const auto& t : mesh.triangles.rowwise()) {
    elements.push_back({{t[0], t[1]}, {t[1], t[2]}, {t[2], t[0]}, {t[0], centre}, {t[1], centre}, {t[2], centre}});
  }
  return pairs_rest_of(with_centre, elements);
}

PairsRest with_normals(PairsRest rest, unsigned seed) {
  const Index count = static_cast<Index>(rest.offsets.size()) - 1;
  rest.normals = unit_vectors(count, seed);
  rest.normal_weights = unit_vectors(count, seed + 1).col(0).cwiseAbs();
  return rest;
}

PairsRest with_negative_weights(PairsRest rest) {
  for (Index p = 0; p < rest.weights.size(); p += 3) rest.weights[p] = -0.3;
  return rest;
}

std::vector<PairsCase> pairs_cases() {
  const PairsRest round = vertex_pairs(sphere(1, 2));
  const PairsRest flat = triangle_pairs(sheet(8));
  PairsRest gaps = flat;
  gaps.offsets = {0, 0, 3, 3, 3, 9, 9};
  const Mesh triangle{Eigen::Matrix3d{{0, 0, 0}, {1, 0, 0}, {0.3, 0.8, 0.1}}, Triangles(Eigen::RowVector3i(0, 1, 2))};
  const Mesh far = transformed(sphere(1, 2), 1, {1e3, -2e3, 5e2});
  const Eigen::Vector3d away = far.positions.row(0);
  const Eigen::Vector3d mirror(1, 1, -1), line(1, 0, 0);
  std::vector<PairsCase> cases{
      moved_case("closed", round),
      moved_case("triangles", triangle_pairs(torus())),
      moved_case("flat, with boundary", vertex_pairs(sheet(20))),
      moved_case("flat triangles", flat),
      moved_case("needles", vertex_pairs(stretched_mesh(sheet(20), {1, 1e-3, 1}))),
      moved_case("tetrahedra", tetrahedron_pairs(sphere(1, 2))),
      moved_case("flat tetrahedra", tetrahedron_pairs(sheet(8))),
      moved_case("random", vertex_pairs({unit_vectors(torus().positions.rows(), 3), torus().triangles})),
      moved_case("one element", triangle_pairs(triangle)),
      moved_case("some elements empty", gaps),
      moved_case("none", triangle_pairs({Positions::Zero(1, 3), Triangles(0, 3)})),
      moved_case("nothing at all", PairsRest{Positions(0, 3), {}, {}, {}, {}, {}}),
      moved_case("tiny", vertex_pairs(transformed(sphere(1, 2), 1e-4, {0, 0, 0})), 1e-4),
      moved_case("huge", vertex_pairs(transformed(sphere(1, 2), 1e4, {0, 0, 0})), 1e4),
      moved_case("with normals", with_normals(round)),
      moved_case("flat with normals", with_normals(flat)),
      moved_case("huge with normals", with_normals(vertex_pairs(transformed(sphere(1, 2), 1e4, {0, 0, 0}))), 1e4),
      moved_case("negative weights", with_negative_weights(round)),
      {"far away", vertex_pairs(far),
       shaken(far.positions.rowwise() - away.transpose(), 1, 1).rowwise() + 3 * away.transpose(), Positions(0, 3)},
      {"mirrored", round, round.vertices * mirror.asDiagonal(), Positions(0, 3)},
      {"onto a line", round, round.vertices * line.asDiagonal(), Positions(0, 3)},
      {"onto a point", round, 0 * round.vertices, Positions(0, 3)},
  };
  return cases;
}

Eigen::Matrix3d matrix(const Transforms& transforms, Index row) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(transforms.row(row).data());
}

Eigen::Matrix3d covariance(const PairsCase& of, Index element, bool normals) {
  const auto at = static_cast<size_t>(element);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (int p = of.rest.offsets[at]; p < of.rest.offsets[at + 1]; ++p) {
    const auto pair = of.rest.pairs.row(p);
    sum += of.rest.weights[p] * (of.positions.row(pair[1]) - of.positions.row(pair[0])).transpose() *
           (of.rest.vertices.row(pair[1]) - of.rest.vertices.row(pair[0]));
  }
  if (!normals || of.rest.normals.rows() == 0) return sum;
  return sum + of.rest.normal_weights[element] * of.targets.row(element).transpose() * of.rest.normals.row(element);
}

double covariance_size(const PairsCase& of, Index element) {
  const auto at = static_cast<size_t>(element);
  double sum = of.rest.normals.rows() == 0 ? 0 : std::abs(of.rest.normal_weights[element]);
  for (int p = of.rest.offsets[at]; p < of.rest.offsets[at + 1]; ++p) {
    const auto pair = of.rest.pairs.row(p);
    sum += std::abs(of.rest.weights[p]) * (of.positions.row(pair[1]) - of.positions.row(pair[0])).norm() *
           (of.rest.vertices.row(pair[1]) - of.rest.vertices.row(pair[0])).norm();
  }
  return sum;
}

NormalFitStep::Rest triangles_around(const Mesh& mesh) {
  const auto count = static_cast<int>(mesh.positions.rows());
  const Lists around = triangles_of_vertices(mesh.triangles, count);
  NormalFitStep::Rest rest{{0}, {}, static_cast<int>(mesh.triangles.rows())};
  for (int v = 0; v < count; ++v) {
    for (const int t : around[v]) rest.triangles.push_back(t);
    rest.offsets.push_back(static_cast<int>(rest.triangles.size()));
  }
  return rest;
}

}  // namespace swage::test
