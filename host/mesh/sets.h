// Sets that grow together.
#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

namespace swage {

/// Disjoint sets of ints from 0, each told by its lowest member.
class Sets {
 public:
  explicit Sets(int count) : parents_(static_cast<std::size_t>(count)) {
    std::iota(parents_.begin(), parents_.end(), 0);
  }

  int of(int i) {
    while (parent(i) != i) i = parent(i) = parent(parent(i));
    return i;
  }

  void join(int i, int j) {
    const int a = of(i), b = of(j);
    if (a < b) {
      parent(b) = a;
    } else {
      parent(a) = b;
    }
  }

  int count() {
    int sets = 0;
    for (int i = 0; i < static_cast<int>(parents_.size()); ++i) sets += of(i) == i ? 1 : 0;
    return sets;
  }

 private:
  int& parent(int i) { return parents_[static_cast<std::size_t>(i)]; }

  std::vector<int> parents_;
};

}  // namespace swage
