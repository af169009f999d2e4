// Edges at their bound tie the vertices of a line together.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "bounded.h"
#include "merge.h"

namespace swage {

/// Lines stand side by side in layers, a vertex of each in every layer.
struct Ties {
  Eigen::Index layer = 0, count = 0;     // Vertices of a layer, and of a line.
  AtBound at_bound = {};                 // Edges, told by their first vertices.
  std::vector<Eigen::Index> lines = {};  // Those that have an edge at its bound.

  /// Calls work(first, last) for stretches of a line's vertices that are tied together.
  template <typename Work>
  void each_block(Eigen::Index line, const Work& work) const {
    for (Eigen::Index first = 0; first < count;) {
      Eigen::Index last = first;
      while (last + 1 < count && at_bound[static_cast<size_t>(line + last * layer)] != 0) ++last;
      if (last > first) work(first, last);
      first = last + 1;
    }
  }

  void find_lines() {
    lines.clear();
    for (Eigen::Index line = 0; line < layer; ++line) {
      bool any = false;
      each_block(line, [&](Eigen::Index, Eigen::Index) { any = true; });
      if (any) lines.push_back(line);
    }
  }

  /// Tied vertices get the mean of what they have; those tied to the ends of a line, which are held, nothing.
  template <typename Scalar>
  void keep(Values<Scalar>& vector) const {
#pragma omp parallel for schedule(static) if (static_cast <Eigen::Index>(lines.size()) * count > kManyEntries)
    for (const Eigen::Index line : lines) {
      each_block(line, [&](Eigen::Index first, Eigen::Index last) {
        Scalar mean = 0;
        for (Eigen::Index i = first; i <= last; ++i) mean += vector[line + i * layer];
        mean /= static_cast<Scalar>(last - first + 1);
        if (first == 0 || last == count - 1) mean = 0;
        for (Eigen::Index i = first; i <= last; ++i) vector[line + i * layer] = mean;
      });
    }
  }
};

}  // namespace swage
