#include "shape_quality.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "measures.h"

namespace swage {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

struct Shape {
  double area, smallest_angle;
  std::array<double, 3> sides;
};

Shape shape_of(const Positions& positions, const Eigen::RowVector3i& triangle) {
  const Eigen::Matrix3d corners = positions(triangle, Eigen::all);
  const Eigen::RowVector3d a = corners.row(0), ab = corners.row(1) - a, ac = corners.row(2) - a;
  return {ab.cross(ac).norm() / 2, corner_angles(corners).minCoeff(), {ab.norm(), (ac - ab).norm(), ac.norm()}};
}

}  // namespace

ShapeQuality shape_quality(const Positions& positions, const Triangles& triangles) {
  ShapeQuality quality;
  quality.triangles = static_cast<int>(triangles.rows());
  if (quality.triangles == 0) return quality;
  double area = 0, sharp = 0, length = 0, longest = 0, mean_shape = 0;
  std::vector<double> angles;
  for (const auto& triangle : triangles.rowwise()) {
    const Shape shape = shape_of(positions, triangle);
    area += shape.area;
    if (shape.smallest_angle < 10 * kDegree) sharp += shape.area;
    angles.push_back(shape.smallest_angle);
    double squares = 0;
    for (const double side : shape.sides) length += side, longest = std::max(longest, side), squares += side * side;
    if (squares > 0) mean_shape += 4 * std::numbers::sqrt3 * shape.area / squares / quality.triangles;
  }
  const double mean = length / (3.0 * quality.triangles);
  const auto low = angles.begin() + quality.triangles / 20;
  std::nth_element(angles.begin(), low, angles.end());
  quality.low_angle = *low;
  quality.least_angle = *std::min_element(angles.begin(), angles.end());
  quality.mean = mean_shape;
  if (area > 0) quality.sharp_area = sharp / area;
  if (mean > 0) quality.longest_over_mean = longest / mean;
  if (mean > 0) quality.mean_over_diagonal = mean / box_diagonal(positions(triangles.reshaped(), Eigen::all));
  return quality;
}

bool has_needles(const ShapeQuality& quality) { return quality.low_angle < 10 * kDegree || quality.sharp_area > 0.1; }

bool is_uneven(const ShapeQuality& quality) { return quality.longest_over_mean > 8; }

bool is_coarse(const ShapeQuality& quality) { return quality.mean_over_diagonal > 0.08; }

bool badly_shaped(const ShapeQuality& quality) {
  return has_needles(quality) || is_uneven(quality) || is_coarse(quality);
}

}  // namespace swage
