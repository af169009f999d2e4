#include "aggregation.h"

#include <algorithm>
#include <numeric>

namespace swage {
namespace {

using Eigen::Index;

constexpr size_t kNeighboursWorthThreads = 100'000;  // Neighbours.

/// How much a pair holds its elements together in the two directions in which it does most: across a sharp edge,
/// surfaces stretch independently, and must not be merged before others.
float strength(const PackedCoupling& c) {
  const float trace = c[0] + c[3] + c[5];
  const float minors = c[0] * c[3] - c[1] * c[1] + c[0] * c[5] - c[2] * c[2] + c[3] * c[5] - c[4] * c[4];
  return trace > 0 ? minors / trace + 1e-3F * trace : 0;
}

}  // namespace

Eigen::Matrix3d unpacked(const PackedCoupling& packed) {
  const Eigen::Matrix<double, 1, 6> c = packed.cast<double>();
  return (Eigen::Matrix3d() << c[0], c[1], c[2], c[1], c[3], c[4], c[2], c[4], c[5]).finished();
}

Eigen::Index Couplings::find(Index element, int other) const {
  return std::lower_bound(neighbours.begin() + begin(element), neighbours.begin() + end(element), other) -
         neighbours.begin();
}

Couplings couplings_of(const ElementGraph& graph, const Poll& poll) {
  const auto count = static_cast<size_t>(graph.own.rows());
  std::vector<int> ends(count + 1, 0);
  for (const auto& [i, j] : graph.pairs) {
    if (i == j) continue;
    ++ends[static_cast<size_t>(i) + 1];
    ++ends[static_cast<size_t>(j) + 1];
  }
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<std::pair<int, int>> entries(static_cast<size_t>(ends.back()));  // Neighbour and pair.
  std::vector<int> next(ends.begin(), ends.end() - 1);
  for (size_t p = 0; p < graph.pairs.size(); ++p) {
    const auto [i, j] = graph.pairs[p];
    if (i == j) continue;
    entries[static_cast<size_t>(next[static_cast<size_t>(i)]++)] = {j, static_cast<int>(p)};
    entries[static_cast<size_t>(next[static_cast<size_t>(j)]++)] = {i, static_cast<int>(p)};
  }
  ask(poll);
#pragma omp parallel for schedule(static) if (entries.size() > kNeighboursWorthThreads)
  for (Index i = 0; i < static_cast<Index>(count); ++i) {
    std::sort(entries.begin() + ends[static_cast<size_t>(i)], entries.begin() + ends[static_cast<size_t>(i) + 1]);
  }
  ask(poll);
  Couplings result;
  result.offsets.assign(1, 0);
  result.neighbours.reserve(entries.size());
  result.values.resize(static_cast<Index>(entries.size()), 6);
  Index filled = 0;
  for (size_t i = 0; i < count; ++i) {
    for (int k = ends[i]; k < ends[i + 1]; ++k) {
      const auto [j, p] = entries[static_cast<size_t>(k)];
      if (k == ends[i] || result.neighbours.back() != j) {
        result.neighbours.push_back(j);
        result.values.row(filled++).setZero();
      }
      result.values.row(filled - 1) += graph.couplings.row(p);
    }
    result.offsets.push_back(static_cast<int>(result.neighbours.size()));
  }
  result.values.conservativeResize(filled, 6);
  return result;
}

Merge pairing(const Couplings& couplings) {
  const auto count = static_cast<Index>(couplings.offsets.size()) - 1;
  Merge merge{std::vector<int>(static_cast<size_t>(count), -1), 0};
  for (Index i = 0; i < count; ++i) {
    if (merge.into[static_cast<size_t>(i)] >= 0) continue;
    int best = -1;
    float most = 0;
    for (Index k = couplings.begin(i); k < couplings.end(i); ++k) {
      const float strong = strength(couplings.values.row(k));
      if (merge.into[static_cast<size_t>(couplings.neighbour(k))] < 0 && strong > most) {
        best = couplings.neighbour(k);
        most = strong;
      }
    }
    merge.into[static_cast<size_t>(i)] = merge.count;
    if (best >= 0) merge.into[static_cast<size_t>(best)] = merge.count;
    ++merge.count;
  }
  return merge;
}

ElementGraph merged(const Couplings& couplings, const ElementGraph::Rows& own, int rows, const Merge& merge) {
  ElementGraph coarse;
  coarse.rows = rows;
  coarse.own.setZero(merge.count, own.cols());
  for (Index i = 0; i < own.rows(); ++i) coarse.own.row(merge.into[static_cast<size_t>(i)]) += own.row(i);
  coarse.couplings.resize(couplings.values.rows() / 2, 6);
  Index filled = 0;
  for (Index i = 0; i < own.rows(); ++i) {
    const int a = merge.into[static_cast<size_t>(i)];
    for (Index k = couplings.begin(i); k < couplings.end(i); ++k) {
      const int j = couplings.neighbour(k), b = merge.into[static_cast<size_t>(j)];
      if (i >= j || a == b) continue;
      coarse.pairs.emplace_back(a, b);
      coarse.couplings.row(filled++) = couplings.values.row(k);
    }
  }
  coarse.couplings.conservativeResize(filled, 6);
  return coarse;
}

}  // namespace swage
