#include "points_near.h"

#include <cmath>
#include <random>

#include "measures.h"
#include "shapes.h"

namespace swage::test {

Mesh bumpy_sphere(int subdivisions) {
  Mesh mesh = sphere(1, subdivisions);
  for (auto p : mesh.positions.rowwise()) {
    p *= 1 + 0.1 * std::sin(7 * p[0]) * std::sin(6 * p[1] + 1) * std::cos(5 * p[2]);
  }
  return mesh;
}

Positions points_near(const Mesh& mesh, int count, double distance) {
  const double reach = distance * mean_edge_length(mesh.positions, mesh.triangles);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  Positions points(count, 3);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::RowVector3i corners = mesh.triangles.row(i * mesh.triangles.rows() / count);
    Eigen::RowVector3d weights(unit(random), unit(random), unit(random));
    Eigen::RowVector3d off(unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5);
    weights /= weights.sum();
    off *= reach * unit(random) / off.norm();
    points.row(i) = off;
    for (int k = 0; k < 3; ++k) points.row(i) += weights[k] * mesh.positions.row(corners[k]);
  }
  return points;
}

Mesh soup(const Mesh& mesh) {
  Mesh result{mesh.positions(mesh.triangles.reshaped<Eigen::RowMajor>(), Eigen::all), mesh.triangles};
  for (int i = 0; i < result.triangles.size(); ++i) result.triangles.data()[i] = i;
  return result;
}

}  // namespace swage::test
