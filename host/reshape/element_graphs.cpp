// The two global systems as multigrid takes them: own terms and couplings.
#include "element_graphs.h"

#include "sphericity.h"

namespace swage {
namespace {

using Row6 = Eigen::Matrix<float, 1, 6>;

Row6 packed(const Eigen::Matrix3d& m) {
  Row6 row;
  row << static_cast<float>(m(0, 0)), static_cast<float>(m(0, 1)), static_cast<float>(m(0, 2)),
      static_cast<float>(m(1, 1)), static_cast<float>(m(1, 2)), static_cast<float>(m(2, 2));
  return row;
}

/// A corner's term is at most what twice the squares of its two sides are.
void add_corners(const TransformStep::Rest& rest, ElementGraph& graph) {
  for (Eigen::Index t = 0; t < rest.triangles.rows(); ++t) {
    if (rest.sphericities[t] == 0) continue;
    for (int k = 0; k < 3; ++k) {
      const int e = rest.triangle_edges(t, k);
      // Each side is beside two corners of the triangle.
      const auto weight = static_cast<float>(4 * rest.sphericities[t] / rest.edge_vectors.row(e).squaredNorm());
      graph.couplings.row(e) += weight * (Row6() << 1, 0, 0, 1, 0, 1).finished();
    }
  }
}

/// (sum of f_i x_i)² = -sum of f_i f_j (x_i - x_j)² where the f are of sum 0; leaving out what that subtracts bounds
/// it.
void add_tie(const Tie& tie, ElementGraph& graph, std::vector<float>& weights) {
  for (size_t a = 0; a < tie.factors.size(); ++a) {
    for (size_t b = a + 1; b < tie.factors.size(); ++b) {
      const double weight = -tie.weight * tie.factors[a].second * tie.factors[b].second;
      if (weight <= 0) continue;
      graph.pairs.emplace_back(tie.factors[a].first, tie.factors[b].first);
      weights.push_back(static_cast<float>(weight));
    }
  }
}

void add_ties(const std::vector<Tie>& ties, ElementGraph& graph) {
  std::vector<float> weights;
  const Eigen::Index first = graph.couplings.rows();
  for (const Tie& tie : ties) add_tie(tie, graph, weights);
  graph.couplings.conservativeResize(first + static_cast<Eigen::Index>(weights.size()), Eigen::NoChange);
  for (size_t i = 0; i < weights.size(); ++i) {
    graph.couplings.row(first + static_cast<Eigen::Index>(i)) = weights[i] * (Row6() << 1, 0, 0, 1, 0, 1).finished();
  }
}

}  // namespace

ElementGraph transform_graph(const TransformStep::Rest& rest) {
  ElementGraph graph;
  graph.rows = 3;
  graph.couplings.resize(rest.pairs.rows(), 6);
  graph.pairs.reserve(static_cast<size_t>(rest.pairs.rows()));
  for (const auto& pair : rest.pairs.rowwise()) graph.pairs.emplace_back(pair[0], pair[1]);
#pragma omp parallel for schedule(static)
  for (Eigen::Index p = 0; p < rest.pairs.rows(); ++p) graph.couplings.row(p) = packed(pair_block(rest, p));
  graph.own.resize(rest.triangles.rows(), 45);
#pragma omp parallel for schedule(static)
  for (Eigen::Index t = 0; t < rest.triangles.rows(); ++t) {
    const Eigen::Matrix<double, 9, 9> block = triangle_block(rest, t);
    for (int i = 0, k = 0; i < 9; ++i) {
      for (int j = 0; j <= i; ++j) graph.own(t, k++) = static_cast<float>(block(i, j));
    }
  }
  return graph;
}

ElementGraph vertex_graph(const TransformStep::Rest& rest, const TransformStep::EdgeQuadratics& quadratics,
                          const std::vector<Tie>& ties, const std::vector<Holds>& holds) {
  ElementGraph graph;
  graph.rows = 1;
  // A transform that is nearly singular makes its edges stiffer than single precision tells from rigid.
  const double stiffest = 1e4 / (rest.mean_edge_length * rest.mean_edge_length);
  const Eigen::ArrayXd stiffness = quadratics.blocks.col(0) + quadratics.blocks.col(3) + quadratics.blocks.col(5);
  graph.couplings = ((stiffest / stiffness).min(1).matrix().asDiagonal() * quadratics.blocks).cast<float>();
  graph.pairs.reserve(static_cast<size_t>(rest.edges.rows()));
  for (const auto& edge : rest.edges.rowwise()) graph.pairs.emplace_back(edge[0], edge[1]);
  add_corners(rest, graph);
  if (!ties.empty()) add_ties(ties, graph);
  graph.own.setZero(rest.vertices.rows(), 6);
  for (const Holds& held : holds) {
    for (const Hold& hold : held.points) {
      for (size_t k = 0; k < 3; ++k) {
        const double factor = hold.factors[static_cast<Eigen::Index>(k)];
        for (const int diagonal : {0, 2, 5}) {
          graph.own(hold.vertices[k], diagonal) += static_cast<float>(hold.share * held.weight * factor * factor);
        }
      }
    }
  }
  return graph;
}

}  // namespace swage
