#include "scaffold_edges.h"

#include <algorithm>

namespace swage {

std::vector<std::array<int, 2>> scaffold_edges(const Tetrahedra& tetrahedra, const std::vector<int>& component) {
  const auto surface_vertices = static_cast<int>(component.size());
  const auto joins = [&](int low, int high) {
    if (high >= surface_vertices) return low < surface_vertices;
    return component[static_cast<size_t>(low)] != component[static_cast<size_t>(high)];
  };
  std::vector<std::array<int, 2>> edges;
  for (const auto& corners : tetrahedra.rowwise()) {
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < i; ++j) {
        const auto [low, high] = std::minmax({corners[i], corners[j]});
        if (joins(low, high)) edges.push_back({low, high});
      }
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

}  // namespace swage
