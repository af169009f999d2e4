#include "swage/style_measures.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "adjacency.h"
#include "changes.h"
#include "measures.h"
#include "shape_quality.h"
#include "swage/error.h"

namespace swage {
namespace {

using Eigen::Index;
using Eigen::RowVector3d;

constexpr double kFlat = 1e-3;  // Radians.
const double kUnknown = std::numeric_limits<double>::quiet_NaN();

Eigen::VectorXd angles_between(const Positions& normals, const Positions& targets) {
  Eigen::VectorXd angles(normals.rows());
  for (Index i = 0; i < angles.size(); ++i) {
    const RowVector3d n = normals.row(i).stableNormalized(), t = targets.row(i).stableNormalized();
    angles[i] = n.isZero(0) || t.isZero(0) ? kUnknown : std::atan2(n.cross(t).norm(), n.dot(t));
  }
  return angles;
}

/// Of each vertex, over the triangles around it.
Positions sums_around(const Positions& of_triangles, const Triangles& triangles, Index vertex_count) {
  Positions sums = Positions::Zero(vertex_count, 3);
  for (Index t = 0; t < triangles.rows(); ++t) {
    for (const int v : triangles.row(t)) sums.row(v) += of_triangles.row(t);
  }
  return sums;
}

double mean_known(const std::array<double, 3>& values) {
  double sum = 0;
  int known = 0;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    sum += value;
    ++known;
  }
  return known == 0 ? kUnknown : sum / known;
}

void measure_angles(const Positions& positions, const Triangles& triangles, const GivenNormals& targets,
                    StyleMeasures& measures) {
  const Positions vectors = area_vectors(positions, triangles);
  const Eigen::VectorXd areas = vectors.rowwise().norm();
  if (targets.of_triangles) {
    measures.face_angles = angles_between(vectors, targets.normals);
    measures.angle = spread(measures.face_angles, areas);
    return;
  }
  const Eigen::VectorXd angles = angles_between(sums_around(vectors, triangles, positions.rows()), targets.normals);
  measures.angle = spread(angles, barycentric_areas(positions, triangles));
  measures.face_angles.resize(triangles.rows());
  for (Index t = 0; t < triangles.rows(); ++t) {
    measures.face_angles[t] = mean_known({angles[triangles(t, 0)], angles[triangles(t, 1)], angles[triangles(t, 2)]});
  }
}

double developable_share(const Positions& positions, const Triangles& triangles) {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(positions.rows());
  for (const auto& triangle : triangles.rowwise()) {
    const Eigen::Vector3d angles = corner_angles(Eigen::Matrix3d(positions(triangle, Eigen::all)));
    for (int k = 0; k < 3; ++k) sums[triangle[k]] += angles[k];
  }
  const Eigen::VectorXd areas = barycentric_areas(positions, triangles);
  const Edges edges = edges_of(triangles);
  std::vector<char> is_inner(static_cast<size_t>(positions.rows()), 1);
  for (int e = 0; e < edges.triangles.size(); ++e) {
    if (edges.triangles[e].size() == 2) continue;
    for (const int v : edges.vertices.row(e)) is_inner[static_cast<size_t>(v)] = 0;
  }
  double flat = 0, whole = 0;
  for (Index v = 0; v < positions.rows(); ++v) {
    if (!is_inner[static_cast<size_t>(v)]) continue;
    whole += areas[v];
    if (std::abs(2 * std::numbers::pi - sums[v]) < kFlat) flat += areas[v];
  }
  return whole > 0 ? flat / whole : 0;
}

}  // namespace

StyleMeasures style_measures(const PositionsRef& positions, const TrianglesRef& triangles,
                             const GivenNormals& targets) {
  check(positions, triangles);
  const Index due = targets.of_triangles ? triangles.rows() : positions.rows();
  if (targets.normals.rows() != due) {
    throw InvalidInput("style_measures: targets: " + std::to_string(targets.normals.rows()) + " rows, but there are " +
                       std::to_string(due) + (targets.of_triangles ? " triangles" : " vertices") +
                       "; give one for each");
  }
  StyleMeasures measures;
  measure_angles(positions, triangles, targets, measures);
  measures.developable = developable_share(positions, triangles);
  const ShapeQuality quality = shape_quality(positions, triangles);
  measures.least_angle = quality.least_angle;
  measures.low_angle = quality.low_angle;
  measures.quality = quality.mean;
  return measures;
}

}  // namespace swage
