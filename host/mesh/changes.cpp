#include "changes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "intersections.h"
#include "measures.h"

namespace swage {
namespace {

using AngleAndArea = std::pair<double, double>;

/// The smallest angle that bounds those of 95 % of the area. Sorts.
double percentile_95(std::vector<AngleAndArea>& turns, double area) {
  std::sort(turns.begin(), turns.end());
  double within = 0;
  for (const auto& [angle, part] : turns) {
    within += part;
    if (within >= 0.95 * area) return angle;
  }
  return turns.empty() ? 0 : turns.back().first;
}

}  // namespace

NormalTurns normal_turns(const Positions& before, const Positions& after, const Triangles& triangles) {
  const Positions from = area_vectors(before, triangles), to = area_vectors(after, triangles);
  NormalTurns result;
  std::vector<AngleAndArea> turns;
  double area = 0;
  for (Eigen::Index t = 0; t < from.rows(); ++t) {
    const Eigen::Vector3d n = from.row(t), m = to.row(t);
    if (n.isZero(0) || m.isZero(0)) continue;
    const double angle = std::atan2(n.cross(m).norm(), n.dot(m));
    turns.emplace_back(angle, n.norm());
    area += n.norm();
    result.mean += n.norm() * angle;
    result.max = std::max(result.max, angle);
    result.flipped += angle > std::numbers::pi / 2 ? 1 : 0;
  }
  if (area > 0) result.mean /= area;
  result.percentile_95 = percentile_95(turns, area);
  return result;
}

std::optional<CrossingChange> crossing_change(const Positions& before, const Positions& after,
                                              const Triangles& triangles, std::size_t most_pairs) {
  const Crossings old = self_intersections(before, triangles, most_pairs);
  const Crossings now = self_intersections(after, triangles, most_pairs);
  if (!old.complete || !now.complete) return std::nullopt;
  std::vector<std::array<int, 2>> fresh;
  std::set_difference(now.pairs.begin(), now.pairs.end(), old.pairs.begin(), old.pairs.end(),
                      std::back_inserter(fresh));
  return CrossingChange{static_cast<int>(old.pairs.size()), static_cast<int>(fresh.size())};
}

}  // namespace swage
