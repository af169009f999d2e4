#include "elements.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "spokes_and_rims.h"

namespace swage {
namespace {

using Eigen::Vector3d;

/// Of a tetrahedron's edge: a sixth of the length of the edge that faces it, from a to b, times the cotangent of the
/// angle there, which the faces with c and with d make. All six sum to the volume times |gradient|² of a linear
/// function.
double edge_weight(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  const Vector3d facing = b - a, m = facing.cross(c - a), n = facing.cross(d - a);
  return facing.norm() * m.dot(n) / (6 * m.cross(n).norm());
}

/// Of no volume to speak of: its cotangents are without bound.
bool is_flat_tetrahedron(const Positions& vertices, const Eigen::RowVector4i& t) {
  constexpr double kFlat = 1e-5;
  const auto edge = [&](int i, int j) -> Vector3d { return (vertices.row(t[j]) - vertices.row(t[i])).transpose(); };
  double longest = 0;
  for (int i = 0; i < 4; ++i) {
    for (int j = i + 1; j < 4; ++j) longest = std::max(longest, edge(i, j).norm());
  }
  return !(std::abs(edge(0, 1).cross(edge(0, 2)).dot(edge(0, 3))) > kFlat * longest * longest * longest);
}

using Corners = std::array<int, 3>;

Corners sorted(int a, int b, int c) {
  Corners corners{a, b, c};
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// Around each vertex the triangles that are no face of a tetrahedron.
Lists bare_triangles(const Positions& vertices, const Tetrahedra& tetrahedra, const Triangles& triangles) {
  std::vector<Corners> faces;
  for (const auto& t : tetrahedra.rowwise()) {
    if (is_flat_tetrahedron(vertices, t)) continue;
    for (int k = 0; k < 4; ++k) faces.push_back(sorted(t[k], t[(k + 1) % 4], t[(k + 2) % 4]));
  }
  std::sort(faces.begin(), faces.end());
  std::vector<std::pair<int, int>> bare;
  for (int t = 0; t < triangles.rows(); ++t) {
    if (std::binary_search(faces.begin(), faces.end(), sorted(triangles(t, 0), triangles(t, 1), triangles(t, 2)))) {
      continue;
    }
    for (int k = 0; k < 3; ++k) bare.emplace_back(triangles(t, k), t);
  }
  return lists_from(static_cast<int>(vertices.rows()), bare);
}

}  // namespace

Elements tetrahedron_elements(const Positions& vertices, const Tetrahedra& tetrahedra, const Triangles& triangles,
                              const std::vector<char>& is_flat, double thickness) {
  ElementList list(vertices.rows());
  const auto at = [&](int v) -> Vector3d { return vertices.row(v).transpose(); };
  for (const auto& t : tetrahedra.rowwise()) {
    if (is_flat_tetrahedron(vertices, t)) continue;
    constexpr int kEdges[6][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}};
    for (const auto& [a, b, c, d] : kEdges) {
      list.add(t[a], t[b], edge_weight(at(t[c]), at(t[d]), at(t[a]), at(t[b])));
    }
    for (int k = 0; k < 4; ++k) list.of_vertex(t[k]) = list.next();
    list.close();
  }
  const auto count = static_cast<int>(vertices.rows());
  const Positions weights = half_cotangents(vertices, triangles, is_flat);
  const Lists bare = bare_triangles(vertices, tetrahedra, triangles);
  for (int v = 0; v < count; ++v) {
    if (bare[v].size() == 0) continue;
    if (list.of_vertex(v) < 0) list.of_vertex(v) = list.next();
    add_star(triangles, weights, bare[v], thickness, list);
    list.close();
  }
  return list.take(vertices);
}

}  // namespace swage
