#include "adjacency.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>
#include <utility>

namespace swage {

Lists lists_from(int count, const std::vector<std::pair<int, int>>& pairs) {
  Lists lists;
  lists.offsets.assign(static_cast<size_t>(count) + 1, 0);
  for (const auto& [thing, item] : pairs) ++lists.offsets[static_cast<size_t>(thing) + 1];
  std::partial_sum(lists.offsets.begin(), lists.offsets.end(), lists.offsets.begin());
  lists.items.resize(pairs.size());
  std::vector<int> next(lists.offsets.begin(), lists.offsets.end() - 1);
  for (const auto& [thing, item] : pairs) {
    lists.items[static_cast<size_t>(next[static_cast<size_t>(thing)]++)] = item;
  }
  return lists;
}

Edges edges_of(const Triangles& triangles) {
  struct Side {
    int first, second, triangle, corner;
  };
  std::vector<Side> sides;
  sides.reserve(static_cast<size_t>(triangles.size()));
  for (int t = 0; t < triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const auto [first, second] = std::minmax({triangles(t, k), triangles(t, (k + 1) % 3)});
      sides.push_back({first, second, t, k});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.first, a.second, a.triangle, a.corner) < std::tie(b.first, b.second, b.triangle, b.corner);
  });

  Edges edges;
  edges.triangle_edges.resize(triangles.rows(), 3);
  std::vector<std::pair<int, int>> beside;
  beside.reserve(sides.size());
  std::vector<std::array<int, 2>> vertices;
  for (const Side& side : sides) {
    if (vertices.empty() || vertices.back() != std::array{side.first, side.second}) {
      vertices.push_back({side.first, side.second});
    }
    const int edge = static_cast<int>(vertices.size()) - 1;
    edges.triangle_edges(side.triangle, side.corner) = edge;
    beside.emplace_back(edge, side.triangle);
  }
  edges.vertices.resize(static_cast<Eigen::Index>(vertices.size()), 2);
  for (size_t e = 0; e < vertices.size(); ++e) {
    edges.vertices.row(static_cast<Eigen::Index>(e)) << vertices[e][0], vertices[e][1];
  }
  edges.triangles = lists_from(static_cast<int>(vertices.size()), beside);
  return edges;
}

Lists triangles_of_vertices(const Triangles& triangles, int vertex_count) {
  std::vector<std::pair<int, int>> pairs;
  pairs.reserve(static_cast<size_t>(triangles.size()));
  for (int t = 0; t < triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) pairs.emplace_back(triangles(t, k), t);
  }
  return lists_from(vertex_count, pairs);
}

Lists one_rings(const Edges& edges, int vertex_count) {
  std::vector<std::pair<int, int>> pairs;
  pairs.reserve(static_cast<size_t>(edges.vertices.size()));
  for (int e = 0; e < edges.vertices.rows(); ++e) pairs.emplace_back(edges.vertices(e, 1), edges.vertices(e, 0));
  for (int e = 0; e < edges.vertices.rows(); ++e) pairs.emplace_back(edges.vertices(e, 0), edges.vertices(e, 1));
  return lists_from(vertex_count, pairs);
}

std::vector<int> components(const Triangles& triangles, int vertex_count) {
  std::vector<int> parent(static_cast<size_t>(vertex_count));
  std::iota(parent.begin(), parent.end(), 0);
  auto root = [&](int v) {
    while (parent[static_cast<size_t>(v)] != v) {
      int& up = parent[static_cast<size_t>(v)];
      up = parent[static_cast<size_t>(up)];
      v = up;
    }
    return v;
  };
  for (int t = 0; t < triangles.rows(); ++t) {
    for (int k = 0; k < 2; ++k) {
      const auto [low, high] = std::minmax({root(triangles(t, k)), root(triangles(t, k + 1))});
      parent[static_cast<size_t>(high)] = low;
    }
  }
  // A root is the smallest vertex of its component, so components are numbered by first vertex.
  std::vector<int> component(static_cast<size_t>(vertex_count));
  int count = 0;
  for (int v = 0; v < vertex_count; ++v) {
    const int r = root(v);
    component[static_cast<size_t>(v)] = r == v ? count++ : component[static_cast<size_t>(r)];
  }
  return component;
}

}  // namespace swage
