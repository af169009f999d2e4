#include "weld.h"

#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include "distinct.h"

namespace swage {
namespace {

/// Which triangles have three vertices that no triangle before has.
std::vector<int> first_of_each(const Triangles& triangles) {
  std::set<std::array<int, 3>> seen;
  std::vector<int> firsts;
  for (int t = 0; t < triangles.rows(); ++t) {
    std::array<int, 3> corners{triangles(t, 0), triangles(t, 1), triangles(t, 2)};
    std::sort(corners.begin(), corners.end());
    if (corners[0] == corners[1] || corners[1] == corners[2]) continue;
    if (seen.insert(corners).second) firsts.push_back(t);
  }
  return firsts;
}

}  // namespace

Mesh welded(const Positions& positions, const Triangles& triangles) {
  const std::vector<int> firsts = first_at_place(positions);
  const Triangles merged = triangles.unaryExpr([&](int v) { return firsts[static_cast<size_t>(v)]; });
  Mesh mesh{{}, merged(first_of_each(merged), Eigen::all)};
  std::vector<int> numbers(static_cast<size_t>(positions.rows()), -1), vertices;
  for (const int v : mesh.triangles.reshaped()) numbers[static_cast<size_t>(v)] = 0;
  for (size_t v = 0; v < numbers.size(); ++v) {
    if (numbers[v] < 0) continue;
    numbers[v] = static_cast<int>(vertices.size());
    vertices.push_back(static_cast<int>(v));
  }
  mesh.positions = positions(vertices, Eigen::all);
  mesh.triangles = mesh.triangles.unaryExpr([&](int v) { return numbers[static_cast<size_t>(v)]; }).eval();
  return mesh;
}

}  // namespace swage
