// Chains of vertices, and the edges in them.
#pragma once

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace swage::test {

using Chains = std::vector<std::vector<int>>;

inline std::set<std::pair<int, int>> edges_in(const Chains& chains) {
  std::set<std::pair<int, int>> edges;
  for (const std::vector<int>& chain : chains) {
    for (size_t i = 1; i < chain.size(); ++i) edges.insert(std::minmax(chain[i - 1], chain[i]));
  }
  return edges;
}

}  // namespace swage::test
