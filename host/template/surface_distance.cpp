#include "surface_distance.h"

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "measures.h"
#include "nearest.h"

namespace swage {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr double kOnSide = 1e-9;  // Barycentric coordinates below are 0.

}  // namespace

SurfaceDistance::SurfaceDistance(Mesh mesh)
    : mesh_(std::move(mesh)),
      edges_(edges_of(mesh_.triangles)),
      scene_(mesh_.positions, mesh_.triangles),
      normals_(unit_normals(mesh_.positions, mesh_.triangles)),
      edge_normals_(Positions::Zero(edges_.vertices.rows(), 3)),
      vertex_normals_(Positions::Zero(mesh_.positions.rows(), 3)) {
  for (Index t = 0; t < mesh_.triangles.rows(); ++t) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.row(k) = mesh_.positions.row(mesh_.triangles(t, k));
    const Vector3d angles = corner_angles(corners);
    for (int k = 0; k < 3; ++k) {
      edge_normals_.row(edges_.triangle_edges(t, k)) += normals_.row(t);
      vertex_normals_.row(mesh_.triangles(t, k)) += angles[k] * normals_.row(t);
    }
  }
  find_closed_parts();
}

/// Closed are components each of whose edges two triangles share that run along it in different directions.
void SurfaceDistance::find_closed_parts() {
  const std::vector<int> component = components(mesh_.triangles, static_cast<int>(mesh_.positions.rows()));
  const auto of = [&](Index t) { return static_cast<size_t>(component[static_cast<size_t>(mesh_.triangles(t, 0))]); };
  std::vector<char> closed(component.size(), 1);
  for (int e = 0; e < edges_.triangles.size(); ++e) {
    const auto beside = edges_.triangles[e];
    const bool is_inner = beside.size() == 2 && runs_along(mesh_.triangles, beside[0], edges_.vertices.row(e)) !=
                                                    runs_along(mesh_.triangles, beside[1], edges_.vertices.row(e));
    if (!is_inner) closed[of(beside[0])] = 0;
  }
  double area = 0, closed_area = 0;
  const Eigen::VectorXd areas = area_vectors(mesh_.positions, mesh_.triangles).rowwise().norm();
  for (Index t = 0; t < mesh_.triangles.rows(); ++t) {
    is_closed_.push_back(closed[of(t)]);
    area += areas[t];
    closed_area += closed[of(t)] != 0 ? areas[t] : 0;
  }
  closed_area_ = closed_area / area;
}

Vector3d SurfaceDistance::pseudonormal(int triangle, const Vector3d& barycentric) const {
  for (int k = 0; k < 3; ++k) {
    if (barycentric[k] > 1 - kOnSide) return vertex_normals_.row(mesh_.triangles(triangle, k));
  }
  for (int k = 0; k < 3; ++k) {
    if (barycentric[k] < kOnSide) return edge_normals_.row(edges_.triangle_edges(triangle, (k + 1) % 3));
  }
  return normals_.row(triangle);
}

SurfaceDistance::Found SurfaceDistance::operator()(const Eigen::RowVector3d& point) const {
  const Vector3d p = point;
  const auto corner = [&](int t, int k) -> Vector3d { return mesh_.positions.row(mesh_.triangles(t, k)); };
  Foot best;
  best.distance = std::numeric_limits<double>::infinity();
  const auto visit = [&](int t) {
    Foot foot = nearest_on_triangle(p, corner(t, 0), corner(t, 1), corner(t, 2));
    foot.triangle = t;
    if (foot.distance < best.distance) best = foot;
    return best.distance;
  };
  scene_.visit_near(p, 10, std::ref(visit));
  if (best.triangle < 0 || is_closed_[static_cast<size_t>(best.triangle)] == 0) return {best.distance, false};
  Vector3d foot = Vector3d::Zero();
  for (int k = 0; k < 3; ++k) foot += best.barycentric[k] * corner(best.triangle, k);
  const bool is_inside = (p - foot).dot(pseudonormal(best.triangle, best.barycentric)) < 0;
  return {is_inside ? -best.distance : best.distance, true};
}

}  // namespace swage
