#include "distinct.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>

#include "measures.h"

namespace swage {
namespace {

/// A triangle's three vertices, ascending, then its number.
using Named = std::array<int, 4>;

/// The first triangle of each three vertices, ascending.
std::vector<int> first_of_each(std::vector<Named> named) {
  std::sort(named.begin(), named.end());
  const auto alike = [](const Named& a, const Named& b) { return std::equal(a.begin(), a.begin() + 3, b.begin()); };
  named.erase(std::unique(named.begin(), named.end(), alike), named.end());
  std::vector<int> firsts(named.size());
  std::transform(named.begin(), named.end(), firsts.begin(), [](const Named& triangle) { return triangle[3]; });
  std::sort(firsts.begin(), firsts.end());
  return firsts;
}

}  // namespace

std::vector<int> first_at_place(const Positions& positions) {
  const auto place = [&](int v) { return std::tuple(positions(v, 0), positions(v, 1), positions(v, 2)); };
  std::vector<int> order(static_cast<size_t>(positions.rows())), firsts(order.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int v, int w) { return place(v) < place(w); });
  int first = -1;
  for (int v : order) {
    if (first < 0 || place(v) != place(first)) first = v;
    firsts[static_cast<size_t>(v)] = first;
  }
  return firsts;
}

Distinct distinct(const Positions& positions, const Triangles& triangles, FlatTriangles flat) {
  const Triangles merged = welded(triangles, first_at_place(positions));
  std::vector<Named> named;
  for (int t = 0; t < merged.rows(); ++t) {
    if (flat == FlatTriangles::dropped && !has_area(positions, merged.row(t))) continue;
    Named corners{merged(t, 0), merged(t, 1), merged(t, 2), t};
    std::sort(corners.begin(), corners.begin() + 3);
    if (corners[0] != corners[1] && corners[1] != corners[2]) named.push_back(corners);
  }
  Distinct result;
  result.originals = first_of_each(std::move(named));
  const Triangles kept = merged(result.originals, Eigen::all);
  result.vertices.assign(kept.data(), kept.data() + kept.size());
  std::sort(result.vertices.begin(), result.vertices.end());
  result.vertices.erase(std::unique(result.vertices.begin(), result.vertices.end()), result.vertices.end());
  result.triangles = kept.unaryExpr([&](int v) {
    return static_cast<int>(std::lower_bound(result.vertices.begin(), result.vertices.end(), v) -
                            result.vertices.begin());
  });
  return result;
}

Triangles welded(const Triangles& triangles, const std::vector<int>& first_at_place) {
  return triangles.unaryExpr([&](int v) { return first_at_place[static_cast<size_t>(v)]; });
}

}  // namespace swage
