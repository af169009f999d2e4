#include "place_and_size.h"

#include <cmath>

namespace swage {

using Eigen::Index;
using Eigen::RowVector3d;

std::vector<PlaceAndSize> places_and_sizes(const StylizePlan& plan, const Positions& positions) {
  const Triangles& triangles = plan.mesh.triangles;
  const Eigen::VectorXd areas = area_vectors(positions, triangles).rowwise().norm() / 2;
  std::vector<PlaceAndSize> all(plan.anchors.size());
  const auto of = [&](Index t) -> PlaceAndSize& {
    return all[static_cast<size_t>(plan.component[static_cast<size_t>(triangles(t, 0))])];
  };
  for (Index t = 0; t < triangles.rows(); ++t) {
    of(t).area += areas[t];
    of(t).centre += areas[t] / 3 * positions(triangles.row(t), Eigen::all).colwise().sum();
  }
  for (PlaceAndSize& one : all) one.centre /= one.area;
  for (Index t = 0; t < triangles.rows(); ++t) {
    const Eigen::Matrix3d corners = positions(triangles.row(t), Eigen::all).rowwise() - of(t).centre;
    of(t).spread += areas[t] / 12 * (corners.squaredNorm() + corners.colwise().sum().squaredNorm());
  }
  for (PlaceAndSize& one : all) one.spread = std::sqrt(one.spread / one.area);
  return all;
}

void restore(const StylizePlan& plan, const std::vector<PlaceAndSize>& as_it_was, const std::vector<char>& is_held,
             Positions& positions) {
  const std::vector<PlaceAndSize> now = places_and_sizes(plan, positions);
  for (Index v = 0; v < positions.rows(); ++v) {
    const auto c = static_cast<size_t>(plan.component[static_cast<size_t>(v)]);
    if (is_held[c] != 0 || !(now[c].spread > 0 && as_it_was[c].spread > 0)) continue;
    const double scale = as_it_was[c].spread / now[c].spread;
    positions.row(v) = as_it_was[c].centre + scale * (positions.row(v) - now[c].centre);
  }
}

}  // namespace swage
