#include "edit_smoothing.h"

#include <algorithm>
#include <cmath>

namespace swage {
namespace {

/// sum_p w_p |a_p|² / 2 of each element: what its own edges count, along an axis of its plane.
Eigen::VectorXd own_spreads(const PairsRest& pairs) {
  Eigen::VectorXd spreads = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(pairs.offsets.size()) - 1);
  for (Eigen::Index i = 0; i < spreads.size(); ++i) {
    for (int p = pairs.offsets[static_cast<size_t>(i)]; p < pairs.offsets[static_cast<size_t>(i) + 1]; ++p) {
      spreads[i] += 0.5 * pairs.weights[p] *
                    (pairs.vertices.row(pairs.pairs(p, 1)) - pairs.vertices.row(pairs.pairs(p, 0))).squaredNorm();
    }
  }
  return spreads;
}

}  // namespace

void join_neighbours(const Edges& edges, const std::vector<char>& is_feature, double sigma, LocalMapStep::Rest& rest) {
  const Positions& at = rest.pairs.vertices;
  const auto count = static_cast<int>(at.rows());
  std::vector<char> on_feature(static_cast<size_t>(count), 0);
  for (Eigen::Index e = 0; e < edges.vertices.rows(); ++e) {
    if (is_feature[static_cast<size_t>(e)] == 0) continue;
    for (const int v : edges.vertices.row(e)) on_feature[static_cast<size_t>(v)] = 1;
  }
  std::vector<std::pair<int, int>> joined;
  for (Eigen::Index e = 0; e < edges.vertices.rows(); ++e) {
    const int a = edges.vertices(e, 0), b = edges.vertices(e, 1);
    const bool across = on_feature[static_cast<size_t>(a)] != 0 || on_feature[static_cast<size_t>(b)] != 0;
    if (across && is_feature[static_cast<size_t>(e)] == 0) continue;
    joined.emplace_back(a, b);
    joined.emplace_back(b, a);
  }
  const Lists near = lists_from(count, joined);
  const Eigen::VectorXd spreads = own_spreads(rest.pairs);
  rest.offsets = near.offsets;
  rest.neighbours = near.items;
  rest.smoothing.resize(static_cast<Eigen::Index>(near.items.size()));
  for (int i = 0; i < count; ++i) {
    for (int k = near.offsets[static_cast<size_t>(i)]; k < near.offsets[static_cast<size_t>(i) + 1]; ++k) {
      const int j = near.items[static_cast<size_t>(k)];
      const double off = rest.pairs.normals.row(i).dot(at.row(j) - at.row(i)) / sigma;
      rest.smoothing[k] = spreads[i] / near[i].size() * std::exp(-off * off);
    }
  }
}

}  // namespace swage
