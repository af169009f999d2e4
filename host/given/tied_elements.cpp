#include "tied_elements.h"

#include <algorithm>
#include <utility>

namespace swage {
namespace {

Eigen::Index element_count(const PairsRest& pairs) { return static_cast<Eigen::Index>(pairs.offsets.size()) - 1; }

/// Weight of all elements together on a mean edge.
double mean_stiffness(const PairsRest& pairs) {
  std::vector<std::pair<int, int>> edges;
  for (const auto& pair : pairs.pairs.rowwise()) edges.emplace_back(pair[0], pair[1]);
  std::sort(edges.begin(), edges.end());
  const auto count = std::unique(edges.begin(), edges.end()) - edges.begin();
  return pairs.weights.sum() / static_cast<double>(count);
}

/// The elements with further edges, and further elements of these alone.
Elements with_edges(const Positions& vertices, const PairsRest& pairs,
                    const std::vector<std::vector<WeightedEdge>>& further, std::vector<int> of_vertex) {
  ElementList list(vertices.rows());
  for (size_t n = 0; n < further.size(); ++n) {
    if (static_cast<Eigen::Index>(n) < element_count(pairs)) {
      for (int p = pairs.offsets[n]; p < pairs.offsets[n + 1]; ++p) {
        list.add(pairs.pairs(p, 0), pairs.pairs(p, 1), pairs.weights[p]);
      }
    }
    for (const WeightedEdge& edge : further[n]) list.add(edge.first, edge.second, edge.weight);
    list.close();
  }
  Elements elements = list.take(vertices);
  elements.of_vertex = std::move(of_vertex);
  return elements;
}

}  // namespace

void add_ties(const Positions& vertices, const std::vector<Tie>& ties, double mean_edge_length, Elements& elements) {
  PairsRest& pairs = elements.pairs;
  if (ties.empty()) return;
  const double stiffness = mean_stiffness(pairs) * mean_edge_length * mean_edge_length;
  std::vector<std::vector<WeightedEdge>> of_element(static_cast<size_t>(element_count(pairs)));
  std::vector<int> of_vertex = elements.of_vertex;
  of_vertex.resize(static_cast<size_t>(vertices.rows()), -1);
  const auto add = [&](int v, const WeightedEdge& edge) {
    int& element = of_vertex[static_cast<size_t>(v)];
    if (element < 0) {
      element = static_cast<int>(of_element.size());
      of_element.emplace_back();
    }
    of_element[static_cast<size_t>(element)].push_back(edge);
  };
  for (const Tie& tie : ties) {
    for (const auto& [i, positive] : tie.factors) {
      for (const auto& [j, negative] : tie.factors) {
        if (positive <= 0 || negative >= 0) continue;
        const WeightedEdge half{i, j, -0.5 * stiffness * tie.weight * positive * negative};
        add(i, half);
        add(j, half);
      }
    }
  }
  elements = with_edges(vertices, pairs, of_element, std::move(of_vertex));
}

}  // namespace swage
