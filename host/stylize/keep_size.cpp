#include "keep_size.h"

#include <algorithm>
#include <cmath>

namespace swage {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// #N: sum w |e0|².
VectorXd weights_of(const PairsRest& rest) {
  VectorXd weights = VectorXd::Zero(static_cast<Index>(rest.offsets.size()) - 1);
  for (Index n = 0; n < weights.size(); ++n) {
    const auto at = static_cast<size_t>(n);
    for (int p = rest.offsets[at]; p < rest.offsets[at + 1]; ++p) {
      const Eigen::RowVector3d edge = rest.vertices.row(rest.pairs(p, 1)) - rest.vertices.row(rest.pairs(p, 0));
      weights[n] += rest.weights[p] * edge.squaredNorm();
    }
  }
  return weights;
}

/// Of each component the points' squared distances from their mean, summed.
VectorXd spreads(const StylizePlan& plan, const std::vector<int>& vertices, const Positions& places) {
  const auto count = static_cast<Index>(plan.anchors.size());
  VectorXd counts = VectorXd::Zero(count), squares = VectorXd::Zero(count);
  Positions means = Positions::Zero(count, 3);
  const auto component = [&](size_t i) { return plan.component[static_cast<size_t>(vertices[i])]; };
  for (size_t i = 0; i < vertices.size(); ++i) {
    counts[component(i)] += 1;
    means.row(component(i)) += places.row(static_cast<Index>(i));
  }
  means.array().colwise() /= counts.array().max(1);
  for (size_t i = 0; i < vertices.size(); ++i) {
    squares[component(i)] += (places.row(static_cast<Index>(i)) - means.row(component(i))).squaredNorm();
  }
  return squares;
}

}  // namespace

KeepSize::KeepSize(const StylizePlan& plan, const HeldPoints& points)
    : weights_(weights_of(plan.elements.pairs)),
      least_(VectorXd::Zero(static_cast<Index>(plan.anchors.size()))),
      grows_(plan.anchors.size(), 0) {
  for (Index v = 0; v < weights_.size(); ++v) least_[plan.component[static_cast<size_t>(v)]] += weights_[v];
  const VectorXd rest = spreads(plan, points.fixed, plan.elements.pairs.vertices(points.fixed, Eigen::all));
  const VectorXd now = spreads(plan, points.fixed, points.fixed_targets);
  for (Index c = 0; c < least_.size(); ++c) {
    if (!(rest[c] > 0)) continue;
    least_[c] *= std::min(1.0, now[c] / rest[c]);
    grows_[static_cast<size_t>(c)] = 1;
  }
}

void KeepSize::of(const StylizePlan& plan, StylizeFit& fitted) const {
  VectorXd sums = VectorXd::Zero(least_.size());
  for (Index v = 0; v < weights_.size(); ++v) {
    sums[plan.component[static_cast<size_t>(v)]] += weights_[v] * fitted.scales[v] * fitted.scales[v];
  }
  for (Index v = 0; v < weights_.size(); ++v) {
    const int c = plan.component[static_cast<size_t>(v)];
    if (!(sums[c] > 0) || (grows_[static_cast<size_t>(c)] != 0 && sums[c] >= least_[c])) continue;
    const double factor = std::sqrt(least_[c] / sums[c]);
    fitted.scales[v] *= factor;
    fitted.matrices.row(v) *= factor;
  }
}

}  // namespace swage
