#include "foot.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace swage {
namespace {

using Corners = Eigen::Matrix3d;  // A column each, seen from the point.

Foot foot_at(const Corners& corners, const Eigen::Vector3d& barycentric) {
  return {0, barycentric, (corners * barycentric).squaredNorm()};
}

/// On the side from corner k to the next.
Foot foot_on_side(const Corners& corners, int k) {
  const int l = (k + 1) % 3;
  const Eigen::Vector3d side = corners.col(l) - corners.col(k);
  const double length = side.squaredNorm();
  const double part = length > 0 ? std::clamp(-corners.col(k).dot(side) / length, 0., 1.) : 0;
  Eigen::Vector3d barycentric = Eigen::Vector3d::Zero();
  barycentric[k] = 1 - part;
  barycentric[l] = part;
  return foot_at(corners, barycentric);
}

/// None where the point is not above the inside of the triangle, or that has no area.
Foot foot_inside(const Corners& corners) {
  const Eigen::Vector3d to_b = corners.col(1) - corners.col(0), to_c = corners.col(2) - corners.col(0);
  const Eigen::Vector3d normal = to_b.cross(to_c);
  const double square = normal.squaredNorm();
  const double b = normal.dot(to_c.cross(corners.col(0))) / square;
  const double c = normal.dot(corners.col(0).cross(to_b)) / square;
  if (!(b > 0 && c > 0 && b + c < 1)) return {};
  return foot_at(corners, {1 - (b + c), b, c});
}

}  // namespace

Foot foot_on(const Mesh& mesh, int triangle, const Eigen::Vector3d& point) {
  Corners corners;
  for (int k = 0; k < 3; ++k) corners.col(k) = mesh.positions.row(mesh.triangles(triangle, k)).transpose() - point;
  // Sides even where there is a foot inside: of a needle that is known badly.
  Foot best = foot_inside(corners);
  for (int k = 0; k < 3; ++k) best = std::min(best, foot_on_side(corners, k));
  best.triangle = triangle;
  return best;
}

}  // namespace swage
