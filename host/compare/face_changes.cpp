// What the map of each triangle does to it.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "changes.h"
#include "measures.h"
#include "parts.h"

namespace swage {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// A triangle in its own plane: the columns are its edges from corner 0, the first along x.
Eigen::Matrix2d flattened(const Positions& positions, const Eigen::RowVector3i& corners) {
  const Eigen::RowVector3d from = positions.row(corners[0]);
  const Eigen::RowVector3d first = positions.row(corners[1]) - from, second = positions.row(corners[2]) - from;
  const double length = first.norm();
  Eigen::Matrix2d edges;
  edges << length, first.dot(second) / length, 0, first.cross(second).norm() / length;
  return edges;
}

/// Larger first. From squared norms of sums and differences, so that equal ones come out equal.
Eigen::RowVector2d singular_values(const Eigen::Matrix2d& map) {
  const double sum = std::hypot(map(0, 0) + map(1, 1), map(1, 0) - map(0, 1));
  const double difference = std::hypot(map(0, 0) - map(1, 1), map(1, 0) + map(0, 1));
  return {(sum + difference) / 2, std::abs(sum - difference) / 2};
}

}  // namespace

FaceChanges face_changes(const Positions& rest, const Positions& edit, const Triangles& triangles) {
  const Eigen::Index count = triangles.rows();
  const Eigen::VectorXd none = Eigen::VectorXd::Constant(count, kNone);
  FaceChanges faces{none, Eigen::MatrixX2d::Constant(count, 2, kNone), none, none, none, none};
  const Eigen::VectorXd turns = normal_turns(rest, edit, triangles);
#pragma omp parallel for schedule(static)
  for (Eigen::Index t = 0; t < count; ++t) {
    if (!has_area(rest, triangles.row(t)) || !has_area(edit, triangles.row(t))) continue;
    const Eigen::Matrix2d map = flattened(edit, triangles.row(t)) * flattened(rest, triangles.row(t)).inverse();
    const Eigen::RowVector2d s = singular_values(map);
    faces.turn[t] = turns[t];
    faces.stretches.row(t) = s;
    faces.uneven[t] = std::log(s[0] / s[1]);
    faces.shear[t] = 2 * std::asin(std::min(1.0, (s[0] - s[1]) / (s[0] + s[1])));
    faces.size[t] = std::log(s[0] * s[1]) / 2;
  }
  return faces;
}

}  // namespace swage
