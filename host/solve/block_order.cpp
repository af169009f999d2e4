// In what order a block system's groups are eliminated, and by what factor.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>

#include "block_system.h"

namespace swage {
namespace {

/// Dense blocks pay where the factor's columns are long, whatever the size: the simplicial factor was faster at 31
/// entries a column, by half, and slower at 53 and beyond, 1.6 to 12 times.
FactorKind faster_kind(std::int64_t entries, std::int64_t columns) {
  return has_cholmod() && entries > 40 * columns ? FactorKind::supernodal : FactorKind::simplicial;
}

}  // namespace

std::shared_ptr<const BlockSystem::Pattern> BlockSystem::pattern(int group_count, int width,
                                                                 const std::vector<std::pair<int, int>>& couplings,
                                                                 std::optional<FactorKind> kind) {
  const bool as_given = kind == FactorKind::none;
  Pattern pattern = order(group_count, couplings, as_given);
  pattern.kind = FactorKind::none;
  if (as_given) return std::make_shared<const Pattern>(std::move(pattern));
  const std::int64_t entries = expected_entries(pattern, width);
  if (group_count == 0) kind = FactorKind::simplicial;  // CHOLMOD takes no empty matrix.
  pattern.kind = kind ? *kind : faster_kind(entries, static_cast<std::int64_t>(group_count) * width);
  return std::make_shared<const Pattern>(std::move(pattern));
}

BlockSystem::Pattern BlockSystem::order(int group_count, const std::vector<std::pair<int, int>>& couplings,
                                        bool as_given) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(2 * couplings.size() + static_cast<size_t>(group_count));
  for (const auto& [i, j] : couplings) {
    entries.emplace_back(i, j, 1.0);
    entries.emplace_back(j, i, 1.0);
  }
  // The ordering puts a row without its diagonal aside as dense.
  for (int g = 0; g < group_count; ++g) entries.emplace_back(g, g, 1.0);
  SparseMatrix graph(group_count, group_count);
  graph.setFromTriplets(entries.begin(), entries.end());
  std::vector<int> elimination(static_cast<size_t>(group_count));
  std::iota(elimination.begin(), elimination.end(), 0);
  if (!as_given) elimination = elimination_order(graph);
  const auto groups = static_cast<size_t>(group_count);
  Pattern pattern{std::vector<int>(groups), std::vector<std::vector<int>>(groups),
                  std::vector<std::vector<Ray>>(groups), as_given};
  for (int p = 0; p < group_count; ++p) pattern.place[static_cast<size_t>(elimination[static_cast<size_t>(p)])] = p;
  for (int g = 0; g < group_count; ++g) {
    const int p = pattern.place[static_cast<size_t>(g)];
    std::vector<int>& above = pattern.above[static_cast<size_t>(p)];
    for (SparseMatrix::InnerIterator other(graph, g); other; ++other) {
      const int q = pattern.place[static_cast<size_t>(other.row())];
      if (q < p) above.push_back(q);
    }
    std::sort(above.begin(), above.end());
  }
  for (int p = 0; p < group_count; ++p) {
    const std::vector<int>& above = pattern.above[static_cast<size_t>(p)];
    for (size_t k = 0; k < above.size(); ++k) {
      pattern.below[static_cast<size_t>(above[k])].push_back({p, 3 * static_cast<int>(k)});
    }
  }
  return pattern;
}

/// The factor's entries are counted in int: beyond, its making would end in the dark.
std::int64_t BlockSystem::expected_entries(const Pattern& pattern, int width) {
  std::vector<int> parent(pattern.above.size(), -1), seen_from(pattern.above.size(), -1);
  std::int64_t blocks = 0;
  for (int p = 0; p < static_cast<int>(pattern.above.size()); ++p) {
    seen_from[static_cast<size_t>(p)] = p;
    ++blocks;
    // The row of p in the factor: all on the way up the elimination tree to p.
    for (int q : pattern.above[static_cast<size_t>(p)]) {
      for (; seen_from[static_cast<size_t>(q)] != p; q = parent[static_cast<size_t>(q)]) {
        if (parent[static_cast<size_t>(q)] == -1) parent[static_cast<size_t>(q)] = p;
        seen_from[static_cast<size_t>(q)] = p;
        ++blocks;
      }
    }
  }
  const std::int64_t entries = blocks * width * width;
  if (entries <= std::numeric_limits<int>::max()) return entries;
  throw Unsolvable("factor: the matrix of " + std::to_string(pattern.above.size()) + " elements needs up to " +
                   std::to_string(entries) + " entries, " + std::to_string(std::numeric_limits<int>::max()) +
                   " can be held: take a coarser mesh");
}

}  // namespace swage
