#include "stylized.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "measures.h"
#include "shapes.h"

namespace swage::test {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

/// Degrees from the nearest of the normals, of each triangle.
Eigen::VectorXd angles(const Mesh& mesh, const Positions& positions, const Positions& normals) {
  const Positions units = unit_normals(positions, mesh.triangles);
  Eigen::VectorXd result(units.rows());
  for (Index t = 0; t < units.rows(); ++t) {
    result[t] = std::acos(std::clamp((normals * units.row(t).transpose()).maxCoeff(), -1.0, 1.0)) / kDegree;
  }
  return result;
}

Eigen::VectorXd areas_at(const Mesh& mesh, const Positions& positions) {
  return area_vectors(positions, mesh.triangles).rowwise().norm() / 2;
}

double angle(const Positions& positions, const Eigen::RowVector3i& triangle, int corner) {
  const auto at = [&](int k) -> Vector3d { return positions.row(triangle[(corner + k) % 3]).transpose(); };
  const Vector3d a = at(1) - at(0), b = at(2) - at(0);
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

ClosestNormals cube_normals(bool dynamic) {
  ClosestNormals style = closest_normals(style_shape(StyleShape::cube));
  style.dynamic = dynamic;
  return style;
}

Mesh askew(Mesh mesh) {
  mesh.positions = mesh.positions * Eigen::AngleAxisd(0.7, Vector3d(1, 0.4, 0.3).normalized()).toRotationMatrix();
  return mesh;
}

Mesh bumpy_sphere(double height, int subdivisions) {
  Mesh mesh = sphere(1, subdivisions);
  for (auto p : mesh.positions.rowwise()) {
    p *= 1 + height * std::sin(9 * p[0] + 1) * std::sin(8 * p[1] + 2) * std::sin(10 * p[2]);
  }
  return mesh;
}

double far_apart(const Positions& one, const Positions& other) {
  return (one - other).rowwise().norm().maxCoeff() / box_diagonal(one);
}

double mean_angle(const Mesh& mesh, const Positions& positions, const Positions& normals) {
  const Eigen::VectorXd weights = areas_at(mesh, positions);
  return weights.dot(angles(mesh, positions, normals)) / weights.sum();
}

double share_near(const Mesh& mesh, const Positions& positions, const Positions& normals, double degrees) {
  const Eigen::VectorXd weights = areas_at(mesh, positions);
  return (angles(mesh, positions, normals).array() <= degrees).select(weights, 0).sum() / weights.sum();
}

Eigen::VectorXd angle_defects(const Mesh& mesh, const Positions& positions) {
  Eigen::VectorXd defects = Eigen::VectorXd::Constant(positions.rows(), 2 * std::numbers::pi);
  for (const auto& t : mesh.triangles.rowwise()) {
    for (int k = 0; k < 3; ++k) defects[t[k]] -= angle(positions, t, k);
  }
  return defects;
}

double flat_share(const Mesh& mesh, const Positions& positions) {
  return (angle_defects(mesh, positions).array().abs() < 1e-3).cast<double>().mean();
}

double least_angle(const Mesh& mesh, const Positions& positions) {
  double least = 180;
  for (const auto& t : mesh.triangles.rowwise()) {
    for (int k = 0; k < 3; ++k) least = std::min(least, angle(positions, t, k) / kDegree);
  }
  return least;
}

int turned_over(const Mesh& mesh, const Positions& positions) {
  const Positions before = area_vectors(mesh.positions, mesh.triangles), now = area_vectors(positions, mesh.triangles);
  return static_cast<int>((before.cwiseProduct(now).rowwise().sum().array() <= 0).count());
}

}  // namespace swage::test
