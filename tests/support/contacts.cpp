#include "contacts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace swage::test {

std::vector<std::pair<int, int>> vertices_met(const Assembled& model) {
  constexpr double kOnePlace = 1e-9;
  std::vector<int> part_of, order(static_cast<size_t>(model.mesh.positions.rows()));
  for (size_t p = 0; p < model.parts.size(); ++p) {
    part_of.insert(part_of.end(), static_cast<size_t>(model.parts[p].count), static_cast<int>(p));
  }
  const auto at = [&](int v) { return model.mesh.positions.row(v); };
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return at(a)[0] < at(b)[0]; });
  std::vector<std::pair<int, int>> pairs;
  for (size_t i = 0; i < order.size(); ++i) {
    for (size_t j = i + 1; j < order.size() && at(order[j])[0] - at(order[i])[0] <= kOnePlace; ++j) {
      const int a = order[i], b = order[j];
      if (part_of[static_cast<size_t>(a)] == part_of[static_cast<size_t>(b)]) continue;
      if ((at(a) - at(b)).cwiseAbs().maxCoeff() <= kOnePlace) pairs.emplace_back(a, b);
    }
  }
  return pairs;
}

}  // namespace swage::test
