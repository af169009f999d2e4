#include "edit_measures.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "measures.h"

namespace swage::test {
namespace {

Eigen::VectorXd areas(const Mesh& mesh) { return area_vectors(mesh.positions, mesh.triangles).rowwise().norm() / 2; }

/// Two sides of a triangle in its plane, columns.
Eigen::Matrix2d sides_in_plane(const Positions& positions, const Eigen::RowVector3i& triangle) {
  const Eigen::Vector3d first = positions.row(triangle[1]) - positions.row(triangle[0]);
  const Eigen::Vector3d second = positions.row(triangle[2]) - positions.row(triangle[0]);
  const Eigen::Vector3d along = first.normalized(), across = (second - along * along.dot(second)).normalized();
  Eigen::Matrix2d sides;
  sides << along.dot(first), along.dot(second), 0, across.dot(second);
  return sides;
}

}  // namespace

double mean_normal_change(const Mesh& rest, const Positions& positions) {
  const Positions before = unit_normals(rest.positions, rest.triangles), now = unit_normals(positions, rest.triangles);
  Eigen::VectorXd angles(before.rows());
  for (Eigen::Index t = 0; t < angles.size(); ++t) {
    angles[t] = 180 - dihedral_angle(before.row(t), now.row(t)) * 180 / std::numbers::pi;
  }
  return angles.dot(areas(rest)) / areas(rest).sum();
}

double mean_stretch(const Mesh& rest, const Positions& positions) {
  Eigen::VectorXd stretches(rest.triangles.rows());
  for (Eigen::Index t = 0; t < stretches.size(); ++t) {
    const Eigen::Matrix2d map = sides_in_plane(positions, rest.triangles.row(t)) *
                                sides_in_plane(rest.positions, rest.triangles.row(t)).inverse();
    stretches[t] = 0.5 * Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(map.transpose() * map, Eigen::EigenvaluesOnly)
                             .eigenvalues()
                             .array()
                             .log()
                             .abs()
                             .mean();
  }
  return stretches.dot(areas(rest)) / areas(rest).sum();
}

double handle_error(const Mesh& rest, const Gesture& gesture, const Positions& positions) {
  double error = 0;
  for (const auto& [vertex, target] : gesture.targets) {
    error = std::max(error, (positions.row(vertex).transpose() - target).norm());
  }
  return error / box_diagonal(rest.positions);
}

Deviation deviation(const Positions& one, const Positions& other) {
  const Eigen::Index both = std::min(one.rows(), other.rows());
  const Eigen::VectorXd distances = (one.topRows(both) - other.topRows(both)).rowwise().norm() / box_diagonal(one);
  return {distances.mean(), distances.maxCoeff()};
}

}  // namespace swage::test
