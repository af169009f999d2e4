#include "foot_search.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

#include "measures.h"

namespace swage {
namespace {

using Eigen::Vector3d;

constexpr double kFarthest = 1000;   // From there single precision still tells the unit box's parts apart.
constexpr double kRounding = 1e-12;  // Of a distance in the unit box.

Vector3d brought_near(const Vector3d& point) {
  const Vector3d middle = Vector3d::Constant(0.5), off = point - middle;
  return off.norm() <= kFarthest ? point : middle + kFarthest * off.normalized();
}

}  // namespace

std::vector<Vector3d> sphere_directions(int count) {
  std::vector<Vector3d> directions;
  for (int k = 0; k < count; ++k) {
    const double z = 1 - (2 * k + 1.) / count, radius = std::sqrt(1 - z * z);
    const double angle = 2 * std::numbers::pi * std::numbers::phi * k;
    directions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
  return directions;
}

FootSearch::FootSearch(Mesh mesh, int directions)
    : mesh_(std::move(mesh)),
      scene_(mesh_.positions, mesh_.triangles),
      normals_(area_vectors(mesh_.positions, mesh_.triangles)),
      directions_(sphere_directions(directions)) {}

Foot FootSearch::operator()(const Vector3d& point, const Vector3d& normal, double detour) const {
  const Vector3d from = brought_near(point);
  Foot foot = closest(from, std::numeric_limits<double>::infinity(), {});
  const auto faces = [&](int triangle) { return normals_.row(triangle).dot(normal) >= 0; };
  if (faces(foot.triangle)) return foot;
  const double reach = detour * std::sqrt(foot.squared_distance) + kRounding;
  const Foot facing = closest(from, reach, faces);
  return facing.squared_distance <= reach * reach ? facing : foot;
}

Foot FootSearch::closest(const Vector3d& point, double reach, const RayScene::Accepts& accepts) const {
  Foot best;
  const auto see = [&](int triangle) {
    best = std::min(best, foot_on(mesh_, triangle, point));
    reach = std::min(reach, std::sqrt(best.squared_distance));
  };
  for (const Vector3d& direction : directions_) {
    const int hit = scene_.first_hit(point, direction, reach, accepts);
    if (hit >= 0 && hit != best.triangle) see(hit);
  }
  const auto visit = [&](int triangle) {
    if (!accepts || accepts(triangle)) see(triangle);
    return reach;
  };
  scene_.visit_near(point, reach, std::ref(visit));  // By reference: no memory is asked for.
  return best;
}

}  // namespace swage
