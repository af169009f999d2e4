#include "nearest.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>

namespace swage {
namespace {

using Eigen::Vector3d;

std::vector<Eigen::AlignedBox3d> boxes_of(const Positions& positions, const Triangles& triangles) {
  std::vector<Eigen::AlignedBox3d> boxes(static_cast<size_t>(triangles.rows()));
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) boxes[static_cast<size_t>(t)].extend(positions.row(triangles(t, k)).transpose());
  }
  return boxes;
}

Foot foot_at(const Vector3d& p, const std::array<Vector3d, 3>& corners, const Vector3d& barycentric) {
  const Vector3d at = barycentric[0] * corners[0] + barycentric[1] * corners[1] + barycentric[2] * corners[2];
  return {-1, barycentric, (p - at).norm()};
}

Foot nearest_on_side(const Vector3d& p, const std::array<Vector3d, 3>& corners, int from, int to) {
  const Vector3d& a = corners[static_cast<size_t>(from)];
  const Vector3d side = corners[static_cast<size_t>(to)] - a;
  const double length = side.squaredNorm();
  const double s = length > 0 ? std::clamp((p - a).dot(side) / length, 0.0, 1.0) : 0;
  Vector3d barycentric = Vector3d::Zero();
  barycentric[from] = 1 - s;
  barycentric[to] = s;
  return foot_at(p, corners, barycentric);
}

}  // namespace

Foot nearest_on_triangle(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const std::array<Vector3d, 3> corners{a, b, c};
  const Vector3d normal = (b - a).cross(c - a);
  const double area = normal.squaredNorm();
  if (area > 0) {
    Vector3d barycentric;
    for (int k = 0; k < 3; ++k) {
      const Vector3d& from = corners[static_cast<size_t>((k + 1) % 3)];
      barycentric[k] = (corners[static_cast<size_t>((k + 2) % 3)] - from).cross(p - from).dot(normal) / area;
    }
    if ((barycentric.array() >= 0).all()) return foot_at(p, corners, barycentric / barycentric.sum());
  }
  Foot best{-1, {}, std::numeric_limits<double>::infinity()};
  for (int k = 0; k < 3; ++k) {
    const Foot foot = nearest_on_side(p, corners, k, (k + 1) % 3);
    if (foot.distance < best.distance) best = foot;
  }
  return best;
}

TriangleTree::TriangleTree(const Positions& positions, const Triangles& triangles)
    : positions_(positions), triangles_(triangles), boxes_(boxes_of(positions, triangles)), tree_(boxes_) {}

Foot TriangleTree::foot_on(int triangle, const Vector3d& point) const {
  const auto corner = [&](int k) -> Vector3d { return positions_.row(triangles_(triangle, k)); };
  Foot foot = nearest_on_triangle(point, corner(0), corner(1), corner(2));
  foot.triangle = triangle;
  return foot;
}

Foot TriangleTree::nearest(const Vector3d& point, double most, const std::function<bool(int)>& counts) const {
  Foot best{-1, Vector3d::Zero(), most};
  tree_.near(point, most, [&](int t) {
    if (!counts(t)) return best.distance;
    const Foot foot = foot_on(t, point);
    const bool is_first = best.triangle < 0 || t < best.triangle;
    if (foot.distance < best.distance || (foot.distance == best.distance && is_first)) best = foot;
    return best.distance;
  });
  return best;
}

Foot TriangleTree::nearest(const Vector3d& point) const {
  return nearest(point, std::numeric_limits<double>::infinity(), [](int) { return true; });
}

std::vector<Foot> TriangleTree::all_nearest(const Vector3d& point, double tolerance) const {
  double least = std::numeric_limits<double>::infinity();
  std::vector<Foot> feet;
  tree_.near(point, least, [&](int t) {
    feet.push_back(foot_on(t, point));
    least = std::min(least, feet.back().distance);
    return least + tolerance;
  });
  std::erase_if(feet, [&](const Foot& foot) { return foot.distance > least + tolerance; });
  std::sort(feet.begin(), feet.end(), [](const Foot& a, const Foot& b) { return a.triangle < b.triangle; });
  return feet;
}

}  // namespace swage
