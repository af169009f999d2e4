#include "spokes_and_rims.h"

#include <Eigen/Geometry>

namespace swage {

using Eigen::RowVector3d;
using Eigen::RowVector3i;

Positions half_cotangents(const Positions& positions, const Triangles& triangles, const std::vector<char>& is_flat) {
  Positions result = Positions::Constant(triangles.rows(), 3, 0.5 / std::sqrt(3.0));
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    if (is_flat[static_cast<size_t>(t)] != 0) continue;
    for (int k = 0; k < 3; ++k) {
      const RowVector3d facing = positions.row(triangles(t, (k + 2) % 3));
      const RowVector3d a = positions.row(triangles(t, k)) - facing,
                        b = positions.row(triangles(t, (k + 1) % 3)) - facing;
      result(t, k) = a.dot(b) / (2 * a.cross(b).norm());
    }
  }
  return result;
}

Elements triangle_elements(const Mesh& mesh, const Positions& weights) {
  ElementList list(mesh.positions.rows());
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    const RowVector3i triangle = mesh.triangles.row(t);
    const RowVector3d weight = weights.row(weights.rows() == 1 ? 0 : t);
    for (int k = 0; k < 3; ++k) {
      list.of_vertex(triangle[k]) = list.next();
      list.add(triangle[k], triangle[(k + 1) % 3], weight[k]);
    }
    list.close();
  }
  return list.take(mesh.positions);
}

Elements vertex_elements(const Mesh& mesh, const std::vector<char>& is_flat) {
  return vertex_elements(mesh, half_cotangents(mesh.positions, mesh.triangles, is_flat));
}

Elements vertex_elements(const Mesh& mesh, const Positions& weights) {
  const auto count = static_cast<int>(mesh.positions.rows());
  const Lists around = triangles_of_vertices(mesh.triangles, count);
  ElementList list(count);
  for (int v = 0; v < count; ++v) {
    list.of_vertex(v) = list.next();
    add_star(mesh.triangles, weights, around[v], 1, list);
    list.close();
  }
  return list.take(mesh.positions);
}

void add_star(const Triangles& triangles, const Positions& weights, const Lists::Range& around, double factor,
              ElementList& list) {
  for (const int t : around) {
    for (int k = 0; k < 3; ++k) list.add(triangles(t, k), triangles(t, (k + 1) % 3), factor * weights(t, k));
  }
}

}  // namespace swage
