#include "flat.h"

#include <Eigen/Geometry>
#include <utility>

#include "measures.h"

namespace swage {
namespace {

Eigen::RowVector3d longest_side(const Positions& positions, const Eigen::RowVector3i& triangle) {
  Eigen::RowVector3d longest = Eigen::RowVector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    const Eigen::RowVector3d side = positions.row(triangle[(k + 1) % 3]) - positions.row(triangle[k]);
    if (side.squaredNorm() > longest.squaredNorm()) longest = side;
  }
  return longest;
}

/// Of the flat triangles beside those that are known, which become known: the sum of those, area by area.
std::vector<std::pair<int, Eigen::RowVector3d>> next_to_known(const Positions& areas, const Edges& edges,
                                                              const std::vector<int>& unknown,
                                                              const std::vector<char>& is_unknown) {
  std::vector<std::pair<int, Eigen::RowVector3d>> found;
  for (const int t : unknown) {
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    for (const int e : Eigen::RowVector3i(edges.triangle_edges.row(t))) {
      for (const int other : edges.triangles[e]) {
        if (is_unknown[static_cast<size_t>(other)] == 0) sum += areas.row(other);
      }
    }
    if (!sum.isZero(0)) found.emplace_back(t, sum);
  }
  return found;
}

Eigen::RowVector3d across(const Eigen::RowVector3d& direction, const Eigen::RowVector3d& side) {
  const Eigen::RowVector3d along = side.normalized();
  const Eigen::RowVector3d rest = direction - direction.dot(along) * along;
  return rest.norm() > 1e-3 * direction.norm() ? rest.normalized() : along.unitOrthogonal();
}

}  // namespace

std::vector<char> flat_triangles(const Positions& positions, const Triangles& triangles) {
  constexpr double kFlat = 1e-5;
  const Positions areas = area_vectors(positions, triangles);
  std::vector<char> is_flat(static_cast<size_t>(triangles.rows()));
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const double longest = longest_side(positions, triangles.row(t)).squaredNorm();
    is_flat[static_cast<size_t>(t)] = areas.row(t).norm() > kFlat * longest ? 0 : 1;
  }
  return is_flat;
}

Positions lent_normals(const Positions& positions, const Triangles& triangles, const Edges& edges,
                       const std::vector<char>& is_flat) {
  Positions areas = area_vectors(positions, triangles);
  std::vector<int> unknown;
  for (int t = 0; t < triangles.rows(); ++t) {
    if (is_flat[static_cast<size_t>(t)] != 0) unknown.push_back(t);
  }
  std::vector<char> is_unknown = is_flat;
  while (!unknown.empty()) {
    const auto found = next_to_known(areas, edges, unknown, is_unknown);
    if (found.empty()) break;
    for (const auto& [t, sum] : found) {
      areas.row(t) = sum;
      is_unknown[static_cast<size_t>(t)] = 0;
    }
    std::erase_if(unknown, [&](int t) { return is_unknown[static_cast<size_t>(t)] == 0; });
  }
  for (int t = 0; t < triangles.rows(); ++t) {
    if (is_flat[static_cast<size_t>(t)] == 0) continue;
    areas.row(t) = across(areas.row(t), longest_side(positions, triangles.row(t)));
  }
  areas.rowwise().normalize();
  return areas;
}

}  // namespace swage
