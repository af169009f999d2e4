#include "pairs.h"

#include <algorithm>

namespace swage {
namespace {

using Eigen::Index;

double inverse_or_one(double value) { return value > 0 ? 1 / value : 1; }

double extent(const Positions& vertices) {
  if (vertices.rows() == 0) return 0;
  return (vertices.colwise().maxCoeff() - vertices.colwise().minCoeff()).maxCoeff();
}

double largest(const Eigen::VectorXd& values) { return values.size() == 0 ? 0 : values.cwiseAbs().maxCoeff(); }

/// w_p a_p
Positions weighted_edges(const PairsRest& rest, const PairScales& scales) {
  Positions edges(rest.pairs.rows(), 3);
  for (Index p = 0; p < edges.rows(); ++p) {
    edges.row(p) = scales.per_weight * rest.weights[p] * scales.per_length *
                   (rest.vertices.row(rest.pairs(p, 1)) - rest.vertices.row(rest.pairs(p, 0)));
  }
  return edges;
}

/// w_n n. The other terms are products of two lengths.
Positions weighted_normals(const PairsRest& rest, const PairScales& scales) {
  const double scale = scales.per_weight * scales.per_length * scales.per_length;
  return scale * rest.normal_weights.head(rest.normals.rows()).asDiagonal() * rest.normals;
}

}  // namespace

PairScales::PairScales(const PairsRest& rest) : per_length(inverse_or_one(extent(rest.vertices))) {
  const double normals = rest.normals.rows() == 0 ? 0 : largest(rest.normal_weights) * per_length * per_length;
  per_weight = inverse_or_one(std::max(largest(rest.weights), normals));
}

Index elements_of(const PairsRest& rest) {
  return rest.offsets.empty() ? 0 : static_cast<Index>(rest.offsets.size()) - 1;
}

Pairs::Pairs(const Queue& queue, const PairsRest& rest, const char* stem)
    : Pairs(queue, rest, stem, PairScales(rest)) {}

Pairs::Pairs(const Queue& queue, const PairsRest& rest, const char* stem, const PairScales& scales)
    : queue_(queue),
      vertices_(rest.vertices.rows()),
      per_length_(scales.per_length),
      elements_{static_cast<int>(elements_of(rest)), queue.context->lanes(stem)},
      offsets_(queue, rest.offsets),
      pairs_(queue, rest.pairs, Layout::rows),
      edges_(queue, weighted_edges(rest, scales), Layout::rows),
      normals_(queue, weighted_normals(rest, scales), Layout::rows),
      positions_(queue, rest.vertices.size()),
      targets_(queue, rest.normals.size()),
      result_(queue, Index{9} * elements_.count) {}

void Pairs::show(const Positions& positions, const Positions& targets) {
  if (normals_.size() != 0) targets_.show(targets);
  if (queue_.context->in_host_memory() || positions.rows() == 0) {
    positions_.show(positions);
    return;
  }
  // About a vertex: single precision has no room for a place far away.
  positions_.show(Positions((positions.rowwise() - positions.row(0).eval()) * per_length_));
}

}  // namespace swage
