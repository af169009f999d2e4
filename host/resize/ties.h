// Edges at their bound tie the vertices of a line together.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "bounded.h"
#include "merge.h"

namespace swage {

/// Lines stand side by side in layers, a vertex of each in every layer.
struct Ties {
  /// Vertices of a line that are tied together.
  struct Block {
    Eigen::Index first, count;
    bool low, high;  // Tied to the line's first vertex, or to its last, which are held.
  };

  Eigen::Index layer = 0, count = 0;  // Vertices of a layer, and of a line.
  AtBound at_bound = {};              // Edges, told by their first vertices.
  std::vector<Block> blocks = {};     // Line by line.

  void find_blocks() {
    blocks.clear();
    std::vector<char> any(static_cast<size_t>(layer), 0);
    for (Eigen::Index i = 0; i + 1 < count; ++i) {
      for (Eigen::Index line = 0; line < layer; ++line) any[static_cast<size_t>(line)] |= tied(line + i * layer);
    }
    for (Eigen::Index line = 0; line < layer; ++line) {
      if (any[static_cast<size_t>(line)] == 0) continue;
      for (Eigen::Index first = 0, last = 0; first < count; first = ++last) {
        while (last + 1 < count && tied(line + last * layer) != 0) ++last;
        if (last > first) blocks.push_back({line + first * layer, last - first + 1, first == 0, last == count - 1});
      }
    }
  }

  /// Calls work(block, index of its i-th vertex) for all blocks, by threads where those are many.
  template <typename Work>
  void each_block(const Work& work) const {
#pragma omp parallel for schedule(static) if (static_cast <Eigen::Index>(blocks.size()) > kManyEntries / 8)
    for (const Block& block : blocks) work(block, [&](Eigen::Index i) { return block.first + i * layer; });
  }

  /// Tied vertices get the mean of what they have; those tied to the ends of a line nothing.
  template <typename Scalar>
  void keep(Values<Scalar>& vector) const {
    each_block([&](const Block& block, const auto& vertex) {
      Scalar mean = 0;
      if (!block.low && !block.high) {
        for (Eigen::Index i = 0; i < block.count; ++i) mean += vector[vertex(i)];
        mean /= static_cast<Scalar>(block.count);
      }
      for (Eigen::Index i = 0; i < block.count; ++i) vector[vertex(i)] = mean;
    });
  }

 private:
  char tied(Eigen::Index edge) const { return at_bound[static_cast<size_t>(edge)]; }
};

}  // namespace swage
