#include "clipped.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace swage::test {
namespace {

using Place = std::array<long double, 3>;  // In cells.
using Polygon = std::vector<Place>;

/// What lies where sign (p[u] - at) <= 0 (Sutherland and Hodgman 1974).
Polygon clipped(const Polygon& polygon, size_t u, long double at, int sign) {
  Polygon kept;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Place &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const long double off_a = sign * (a[u] - at), off_b = sign * (b[u] - at);
    if (off_a <= 0) kept.push_back(a);
    if ((off_a < 0 && off_b > 0) || (off_a > 0 && off_b < 0)) {
      const long double part = off_a / (off_a - off_b);
      Place between;
      for (size_t w = 0; w < 3; ++w) between[w] = a[w] + part * (b[w] - a[w]);
      between[u] = at;
      kept.push_back(between);
    }
  }
  return kept;
}

Polygon in_cells(const GridShape& shape, const Eigen::Matrix3d& corners) {
  Polygon polygon(3);
  for (int k = 0; k < 3; ++k) {
    for (int u = 0; u < 3; ++u) {
      const long double off = corners(k, u) - static_cast<long double>(shape.corner[u]);
      polygon[static_cast<size_t>(k)][static_cast<size_t>(u)] =
          shape.extends(u) ? off / shape.size[u] * shape.cells[u] : 0.5L;
    }
  }
  return polygon;
}

}  // namespace

std::vector<int> cells_by_clipping(const GridShape& shape, const Eigen::Matrix3d& corners, long double margin) {
  std::vector<int> cells;
  // A slab's part, a row's part of that, and a cell's of that.
  const auto within = [&](const Polygon& polygon, size_t u, int cell) {
    return clipped(clipped(polygon, u, cell + 1 + margin, 1), u, cell - margin, -1);
  };
  const Polygon whole = in_cells(shape, corners);
  for (int k = 0; k < shape.cells[2]; ++k) {
    const Polygon slab = within(whole, 2, k);
    for (int j = 0; j < shape.cells[1] && !slab.empty(); ++j) {
      const Polygon row = within(slab, 1, j);
      for (int i = 0; i < shape.cells[0] && !row.empty(); ++i) {
        if (!within(row, 0, i).empty()) cells.push_back(static_cast<int>(shape.cells.at(i, j, k)));
      }
    }
  }
  return cells;
}

}  // namespace swage::test
