#include "adjacency.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <utility>

#include "threads.h"

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
  const auto ends = [&triangles](int side) {
    return std::minmax({triangles.data()[side], triangles.data()[side % 3 == 2 ? side - 2 : side + 1]});
  };
  std::vector<std::pair<int, int>> pairs;  // Lower end of a side, and the side: corner k of triangle t is 3t + k.
  pairs.reserve(static_cast<size_t>(triangles.size()));
  for (int side = 0; side < triangles.size(); ++side) pairs.emplace_back(ends(side).first, side);
  const int vertex_count = triangles.size() == 0 ? 0 : triangles.maxCoeff() + 1;
  Lists sides = lists_from(vertex_count, pairs);

  Edges edges;
  edges.triangle_edges.resize(triangles.rows(), 3);
  edges.triangles.items.reserve(sides.items.size());
  std::vector<std::array<int, 2>> vertices;
  for (int v = 0; v < vertex_count; ++v) {
    const auto first = sides.items.begin() + sides.offsets[static_cast<size_t>(v)];
    const auto last = sides.items.begin() + sides.offsets[static_cast<size_t>(v) + 1];
    std::sort(first, last, [&](int a, int b) { return std::pair(ends(a).second, a) < std::pair(ends(b).second, b); });
    for (auto side = first; side != last; ++side) {
      const std::array<int, 2> both{v, ends(*side).second};
      if (vertices.empty() || vertices.back() != both) {
        vertices.push_back(both);
        edges.triangles.offsets.push_back(static_cast<int>(edges.triangles.items.size()));
      }
      edges.triangle_edges.data()[*side] = static_cast<int>(vertices.size()) - 1;
      edges.triangles.items.push_back(*side / 3);
    }
  }
  edges.triangles.offsets.push_back(static_cast<int>(edges.triangles.items.size()));
  edges.vertices.resize(static_cast<Eigen::Index>(vertices.size()), 2);
  for (size_t e = 0; e < vertices.size(); ++e) {
    edges.vertices.row(static_cast<Eigen::Index>(e)) << vertices[e][0], vertices[e][1];
  }
  return edges;
}

int edge_between(const Edges& edges, int a, int b) {
  const auto [low, high] = std::minmax({a, b});
  Eigen::Index first = 0, last = edges.vertices.rows();
  while (first < last) {
    const Eigen::Index middle = (first + last) / 2;
    const bool before = std::pair(edges.vertices(middle, 0), edges.vertices(middle, 1)) < std::pair(low, high);
    (before ? first : last) = before ? middle + 1 : middle;
  }
  const bool found =
      first < edges.vertices.rows() && edges.vertices(first, 0) == low && edges.vertices(first, 1) == high;
  return found ? static_cast<int>(first) : -1;
}

bool runs_along(const Triangles& triangles, int triangle, const Eigen::RowVector2i& edge) {
  for (int k = 0; k < 3; ++k) {
    if (triangles(triangle, k) == edge[0] && triangles(triangle, (k + 1) % 3) == edge[1]) return true;
  }
  return false;
}

Lists triangles_of_vertices(const Triangles& triangles, int vertex_count) {
  std::vector<std::pair<int, int>> pairs;
  pairs.reserve(static_cast<size_t>(triangles.size()));
  for (int t = 0; t < triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) pairs.emplace_back(triangles(t, k), t);
  }
  return lists_from(vertex_count, pairs);
}

Lists corners_of_vertices(const Triangles& triangles, int vertex_count) {
  Lists corners;
  corners.offsets.assign(static_cast<size_t>(vertex_count) + 1, 0);
  corners.items.resize(static_cast<size_t>(triangles.size()));
  const int blocks = most_threads();
  // Each thread reads all corners and writes those of its own vertices.
  const auto each_corner_of = [&](int block, const auto& work) {
    const auto first = static_cast<int>(std::int64_t{vertex_count} * block / blocks);
    const auto end = static_cast<int>(std::int64_t{vertex_count} * (block + 1) / blocks);
    for (int corner = 0; corner < triangles.size(); ++corner) {
      const int v = triangles.data()[corner];
      if (v >= first && v < end) work(corner, corners.offsets[static_cast<size_t>(v)]);
    }
  };
#pragma omp parallel for schedule(static)
  for (int block = 0; block < blocks; ++block) {
    each_corner_of(block, [](int, int& count) { ++count; });
  }
  std::exclusive_scan(corners.offsets.begin(), corners.offsets.end(), corners.offsets.begin(), 0);
#pragma omp parallel for schedule(static)
  for (int block = 0; block < blocks; ++block) {
    each_corner_of(block, [&](int corner, int& next) { corners.items[static_cast<size_t>(next++)] = corner; });
  }
  // Each list now ends where its offset points to: the next one's begins there.
  std::copy_backward(corners.offsets.begin(), corners.offsets.end() - 1, corners.offsets.end());
  corners.offsets[0] = 0;
  return corners;
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
