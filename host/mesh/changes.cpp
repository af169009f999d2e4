#include "changes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "intersections.h"
#include "measures.h"

namespace swage {
Eigen::VectorXd normal_turns(const Positions& before, const Positions& after, const Triangles& triangles) {
  const Positions from = area_vectors(before, triangles), to = area_vectors(after, triangles);
  Eigen::VectorXd turns(from.rows());
  for (Eigen::Index t = 0; t < from.rows(); ++t) {
    const Eigen::Vector3d n = from.row(t), m = to.row(t);
    turns[t] =
        n.isZero(0) || m.isZero(0) ? std::numeric_limits<double>::quiet_NaN() : std::atan2(n.cross(m).norm(), n.dot(m));
  }
  return turns;
}

int flipped(const Eigen::VectorXd& turns) { return static_cast<int>((turns.array() > std::numbers::pi / 2).count()); }

Spread spread(const Eigen::VectorXd& values, const Eigen::VectorXd& weights) {
  std::vector<std::pair<double, double>> known;
  double whole = 0, sum = 0;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) continue;
    known.emplace_back(values[i], weights[i]);
    whole += weights[i];
    sum += weights[i] * values[i];
  }
  if (!(whole > 0)) return {};
  std::sort(known.begin(), known.end());
  Spread result{sum / whole, known.back().first, known.back().first};
  double within = 0;
  for (const auto& [value, weight] : known) {
    within += weight;
    if (within < 0.95 * whole) continue;
    result.percentile_95 = value;
    break;
  }
  return result;
}

double largest_miss(const Gesture& gesture, const Positions& positions) {
  double miss = 0;
  for (const auto& [vertex, target] : gesture.targets) {
    miss = std::max(miss, (positions.row(vertex).transpose() - target).norm());
  }
  return miss;
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
