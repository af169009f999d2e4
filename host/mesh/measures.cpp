#include "measures.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "swage/error.h"

namespace swage {
namespace {

constexpr double kNoHeight = 1e-10;
[[maybe_unused]] constexpr Eigen::Index kWorthThreads = 20000;

}  // namespace

Positions edge_vectors(const Positions& positions, const Edges& edges) {
  Positions vectors(edges.vertices.rows(), 3);
  for (Eigen::Index e = 0; e < vectors.rows(); ++e) {
    vectors.row(e) = positions.row(edges.vertices(e, 1)) - positions.row(edges.vertices(e, 0));
  }
  return vectors;
}

Positions area_vectors(const Positions& positions, const Triangles& triangles) {
  Positions areas(triangles.rows(), 3);
#pragma omp parallel for schedule(static) if (triangles.rows() > kWorthThreads)
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const Eigen::RowVector3d a = positions.row(triangles(t, 0));
    const Eigen::RowVector3d ab = positions.row(triangles(t, 1)) - a, ac = positions.row(triangles(t, 2)) - a;
    areas.row(t) = ab.cross(ac);
  }
  return areas;
}

Positions normalised(Positions rows) {
#pragma omp parallel for schedule(static) if (rows.rows() > kWorthThreads)
  for (Eigen::Index i = 0; i < rows.rows(); ++i) rows.row(i).stableNormalize();
  return rows;
}

Positions unit_normals(const Positions& positions, const Triangles& triangles) {
  Positions normals = area_vectors(positions, triangles);
#pragma omp parallel for schedule(static) if (normals.rows() > kWorthThreads)
  for (Eigen::Index t = 0; t < normals.rows(); ++t) {
    auto normal = normals.row(t);
    normal.normalize();  // All at once, those of length 0 would be NaN.
  }
  return normals;
}

Positions vertex_normals(const Positions& positions, const Triangles& triangles) {
  const Positions areas = area_vectors(positions, triangles);
  Positions sums = Positions::Zero(positions.rows(), 3);
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) sums.row(triangles(t, k)) += areas.row(t);
  }
  return normalised(std::move(sums));
}

Eigen::VectorXd barycentric_areas(const Positions& positions, const Triangles& triangles) {
  const Eigen::VectorXd areas = area_vectors(positions, triangles).rowwise().norm() / 2;
  Eigen::VectorXd result = Eigen::VectorXd::Zero(positions.rows());
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    for (const int v : triangles.row(t)) result[v] += areas[t] / 3;
  }
  return result;
}

Eigen::Vector3d corner_angles(const Eigen::Matrix3d& corners) {
  Eigen::Vector3d angles;
  for (int k = 0; k < 3; ++k) {
    const Eigen::RowVector3d ab = corners.row((k + 1) % 3) - corners.row(k);
    const Eigen::RowVector3d ac = corners.row((k + 2) % 3) - corners.row(k);
    angles[k] = std::atan2(ab.cross(ac).norm(), ab.dot(ac));
  }
  return angles;
}

bool has_area(const Positions& positions, const Eigen::RowVector3i& triangle) {
  const Eigen::RowVector3d a = positions.row(triangle[0]);
  const Eigen::RowVector3d ab = positions.row(triangle[1]) - a, ac = positions.row(triangle[2]) - a;
  // Divided first, so that no product over- or underflows.
  const double longest = std::max({ab.stableNorm(), ac.stableNorm(), (ac - ab).stableNorm()});
  return longest > 0 && (ab / longest).cross(ac / longest).norm() > kNoHeight;
}

double mean_edge_length(const Positions& positions, const Triangles& triangles) {
  double sum = 0;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      sum += (positions.row(triangles(t, (k + 1) % 3)) - positions.row(triangles(t, k))).norm();
    }
  }
  return sum / static_cast<double>(3 * triangles.rows());
}

double dihedral_angle(const Eigen::Vector3d& normal, const Eigen::Vector3d& other) {
  // Both sine and cosine: the cosine alone cannot tell small angles apart.
  return std::numbers::pi - std::atan2(normal.cross(other).norm(), normal.dot(other));
}

double turn_at(const PositionsRef& positions, int before, int vertex, int after) {
  const Eigen::RowVector3d from = positions.row(vertex) - positions.row(before);
  const Eigen::RowVector3d to = positions.row(after) - positions.row(vertex);
  return std::atan2(from.cross(to).norm(), from.dot(to));
}

UnitBox unit_box(const PositionsRef& positions) {
  const Eigen::RowVector3d low = positions.colwise().minCoeff(), high = positions.colwise().maxCoeff();
  const double extent = (high - low).maxCoeff();
  if (!(extent > 0))
    throw InvalidInput("unit_box: positions: all vertices are at one point; check the mesh's units and coordinates");
  return {low, extent};
}

}  // namespace swage
