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

Eigen::VectorXi offsets_of(const PairsRest& rest) {
  return Eigen::Map<const Eigen::VectorXi>(rest.offsets.data(), static_cast<Index>(rest.offsets.size()));
}

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

int whole_items(Index count, int lanes) { return static_cast<int>((count + lanes - 1) / lanes * lanes); }

}  // namespace

PairScales::PairScales(const PairsRest& rest) : per_length(inverse_or_one(extent(rest.vertices))) {
  const double normals = rest.normals.rows() == 0 ? 0 : largest(rest.normal_weights) * per_length * per_length;
  per_weight = inverse_or_one(std::max(largest(rest.weights), normals));
}

Index elements_of(const PairsRest& rest) {
  return rest.offsets.empty() ? 0 : static_cast<Index>(rest.offsets.size()) - 1;
}

PairSums::PairSums(const Queue& queue, const PairsRest& rest) : PairSums(queue, rest, PairScales(rest)) {}

PairSums::PairSums(const Queue& queue, const PairsRest& rest, const PairScales& scales)
    : scales_(scales),
      count_(elements_of(rest)),
      lanes_(queue.context->lanes("rotation")),
      stride_(whole_items(count_, lanes_)),
      normals_(rest.normals.rows() != 0),
      offsets_(queue, offsets_of(rest)),
      pairs_(queue, rest.pairs, Layout::rows),
      edges_(queue, weighted_edges(rest, scales), Layout::rows),
      weighted_normals_(queue, weighted_normals(rest, scales)),
      positions_(queue, rest.vertices.size()),
      targets_(queue, rest.normals.size()),
      edge_sums_(queue, Index{stride_} * 9),
      all_sums_(queue, normals_ ? Index{stride_} * 9 : 0),
      gather_pairs_(queue, "pairs", "gather_pairs"),
      add_normals_(queue, "pairs", "add_normals") {}

void PairSums::gather(const Positions& positions, const Positions& targets) {
  if (positions.rows() != 0) {
    const Eigen::RowVector3d origin = positions.row(0);
    positions_.upload((positions.rowwise() - origin) * scales_.per_length, Layout::rows);
  }
  gather_pairs_.launch(count_, stride_, offsets_, pairs_, edges_, positions_, edge_sums_);
  if (normals_) {
    targets_.upload(targets);
    add_normals_.launch(count_, stride_, edge_sums_, weighted_normals_, targets_, all_sums_);
  }
}

}  // namespace swage
