#include "numbering.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace swage {

Numbering by_neighbourhood(const Mesh& mesh, const Edges& edges) {
  const Triangles& triangles = mesh.triangles;
  const auto vertex_count = static_cast<int>(mesh.positions.rows());
  const Lists ring = one_rings(edges, vertex_count);
  Numbering numbering;
  std::vector<int>& walk = numbering.vertices;
  std::vector<char> met(static_cast<size_t>(vertex_count), 0);
  const auto meet = [&](int v) {
    if (std::exchange(met[static_cast<size_t>(v)], 1) == 0) walk.push_back(v);
  };
  for (int v = 0; v < vertex_count; ++v) {
    size_t next = walk.size();
    for (meet(v); next < walk.size(); ++next) {
      for (const int w : ring[walk[next]]) meet(w);
    }
  }
  const std::vector<int> place = inverse(walk);
  std::vector<int> first(static_cast<size_t>(triangles.rows()));
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    first[static_cast<size_t>(t)] =
        std::min({place[static_cast<size_t>(triangles(t, 0))], place[static_cast<size_t>(triangles(t, 1))],
                  place[static_cast<size_t>(triangles(t, 2))]});
  }
  numbering.triangles.resize(first.size());
  std::iota(numbering.triangles.begin(), numbering.triangles.end(), 0);
  std::stable_sort(numbering.triangles.begin(), numbering.triangles.end(),
                   [&](int a, int b) { return first[static_cast<size_t>(a)] < first[static_cast<size_t>(b)]; });
  return numbering;
}

std::vector<int> inverse(const std::vector<int>& numbers) {
  std::vector<int> places(numbers.size());
  for (size_t i = 0; i < numbers.size(); ++i) places[static_cast<size_t>(numbers[i])] = static_cast<int>(i);
  return places;
}

Mesh in_order(const Mesh& mesh, const Numbering& numbering) {
  const std::vector<int> place = inverse(numbering.vertices);
  Mesh result = mesh;
  result.positions = mesh.positions(numbering.vertices, Eigen::all);
  result.triangles =
      mesh.triangles(numbering.triangles, Eigen::all).unaryExpr([&](int v) { return place[static_cast<size_t>(v)]; });
  return result;
}

}  // namespace swage
