#include "sphericity.h"

#include <Eigen/Geometry>
#include <cmath>

namespace swage {

std::array<Corner, 3> corners(const TransformStep::Rest& rest, Eigen::Index triangle) {
  std::array<Corner, 3> result;
  for (int c = 0; c < 3; ++c) {
    Corner& corner = result[static_cast<size_t>(c)];
    corner.i = rest.triangles(triangle, c);
    corner.j = rest.triangles(triangle, (c + 1) % 3);
    corner.k = rest.triangles(triangle, (c + 2) % 3);
    corner.toward_j = (rest.vertices.row(corner.j) - rest.vertices.row(corner.i)).normalized();
    corner.toward_k = (rest.vertices.row(corner.k) - rest.vertices.row(corner.i)).normalized();
    corner.length_j = rest.edge_vectors.row(rest.triangle_edges(triangle, c)).norm();
    corner.length_k = rest.edge_vectors.row(rest.triangle_edges(triangle, (c + 2) % 3)).norm();
    const Eigen::Vector3d axis = corner.toward_k.cross(corner.toward_j);
    const double angle = std::atan2(axis.norm(), corner.toward_k.dot(corner.toward_j));
    corner.turn = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  }
  return result;
}

}  // namespace swage
