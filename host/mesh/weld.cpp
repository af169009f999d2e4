#include "weld.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace swage {

std::vector<int> first_at_place(const Positions& positions) {
  const auto place = [&](int v) { return std::tuple(positions(v, 0), positions(v, 1), positions(v, 2)); };
  std::vector<int> order(static_cast<size_t>(positions.rows()));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return std::tuple_cat(place(a), std::tuple(a)) < std::tuple_cat(place(b), std::tuple(b));
  });
  std::vector<int> firsts(order.size());
  for (size_t i = 0; i < order.size(); ++i) {
    const bool repeats = i > 0 && place(order[i - 1]) == place(order[i]);
    firsts[static_cast<size_t>(order[i])] = repeats ? firsts[static_cast<size_t>(order[i - 1])] : order[i];
  }
  return firsts;
}

Triangles welded(const Triangles& triangles, const std::vector<int>& first_at_place) {
  return triangles.unaryExpr([&](int v) { return first_at_place[static_cast<size_t>(v)]; });
}

}  // namespace swage
