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

/// Components. Closed are those each of whose edges two triangles share that run along it in different directions.
struct Parts {
  Parts(const Mesh& mesh, const Edges& edges)
      : triangles(mesh.triangles),
        numbers(components(mesh.triangles, static_cast<int>(mesh.positions.rows()))),
        closed(numbers.size(), 1) {
    for (int e = 0; e < edges.triangles.size(); ++e) {
      const auto beside = edges.triangles[e];
      const bool is_inner = beside.size() == 2 && runs_along(triangles, beside[0], edges.vertices.row(e)) !=
                                                      runs_along(triangles, beside[1], edges.vertices.row(e));
      if (!is_inner) closed[of(beside[0])] = 0;
    }
  }

  size_t of(Index triangle) const { return static_cast<size_t>(numbers[static_cast<size_t>(triangles(triangle, 0))]); }

  const Triangles& triangles;
  std::vector<int> numbers;  // Of each vertex.
  std::vector<char> closed;  // By number.
};

/// Closed parts that are wound inside out are turned, but for cavities: those within the box of another.
Mesh outwards(Mesh mesh) {
  const Parts parts(mesh, edges_of(mesh.triangles));
  std::vector<double> volumes(parts.closed.size(), 0);
  std::vector<Eigen::AlignedBox3d> boxes(parts.closed.size());
  for (Index t = 0; t < mesh.triangles.rows(); ++t) {
    const auto corner = [&](int k) -> Vector3d { return mesh.positions.row(mesh.triangles(t, k)); };
    for (int k = 0; k < 3; ++k) boxes[parts.of(t)].extend(corner(k));
    volumes[parts.of(t)] += corner(0).dot(corner(1).cross(corner(2)));
  }
  const auto is_within_another = [&](size_t part) {
    for (size_t other = 0; other < boxes.size(); ++other) {
      if (other != part && parts.closed[other] != 0 && boxes[other].contains(boxes[part])) return true;
    }
    return false;
  };
  std::vector<char> turned(parts.closed.size(), 0);
  for (size_t part = 0; part < turned.size(); ++part) {
    turned[part] = parts.closed[part] != 0 && volumes[part] < 0 && !is_within_another(part) ? 1 : 0;
  }
  for (Index t = 0; t < mesh.triangles.rows(); ++t) {
    if (turned[parts.of(t)] != 0) std::swap(mesh.triangles(t, 1), mesh.triangles(t, 2));
  }
  return mesh;
}

}  // namespace

SurfaceDistance::SurfaceDistance(Mesh mesh)
    : mesh_(outwards(std::move(mesh))),
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

void SurfaceDistance::find_closed_parts() {
  const Parts parts(mesh_, edges_);
  double area = 0, closed_area = 0;
  const Eigen::VectorXd areas = area_vectors(mesh_.positions, mesh_.triangles).rowwise().norm();
  for (Index t = 0; t < mesh_.triangles.rows(); ++t) {
    is_closed_.push_back(parts.closed[parts.of(t)]);
    area += areas[t];
    closed_area += is_closed_.back() != 0 ? areas[t] : 0;
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
