#include "defects.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>
#include <vector>

#include "distinct.h"

namespace swage {
namespace {

void note(FoundElements& found, int element) {
  if (found.count++ == 0) found.first = element;
}

void note(FoundPairs& found, const Eigen::RowVector2i& edge) {
  if (found.count++ == 0) found.first = {edge[0], edge[1]};
}

/// The group of each of `count` things, numbered from 0, where `pairs` join things to groups.
std::vector<int> groups_of(const std::vector<std::pair<int, int>>& pairs, int count) {
  Triangles links(static_cast<Eigen::Index>(pairs.size()), 3);
  for (size_t i = 0; i < pairs.size(); ++i) {
    links.row(static_cast<Eigen::Index>(i)) << pairs[i].first, pairs[i].second, pairs[i].second;
  }
  return components(links, count);
}

int count_different(std::vector<int> values) {
  std::sort(values.begin(), values.end());
  return static_cast<int>(std::unique(values.begin(), values.end()) - values.begin());
}

int count_components(const Triangles& triangles, int vertex_count) {
  const std::vector<int> component = components(triangles, vertex_count);
  std::vector<int> used;
  used.reserve(static_cast<size_t>(triangles.rows()));
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) used.push_back(component[static_cast<size_t>(triangles(t, 0))]);
  return count_different(std::move(used));
}

void count_isolated(Diagnosis& diagnosis, const Triangles& triangles) {
  std::vector<bool> is_used(static_cast<size_t>(diagnosis.vertices));
  for (Eigen::Index c = 0; c < triangles.size(); ++c) is_used[static_cast<size_t>(triangles.data()[c])] = true;
  for (int v = 0; v < diagnosis.vertices; ++v) {
    if (!is_used[static_cast<size_t>(v)]) note(diagnosis.isolated_vertices, v);
  }
}

int corner_of(const Triangles& triangles, int triangle, int vertex) {
  int k = 0;
  while (triangles(triangle, k) != vertex) ++k;
  return 3 * triangle + k;
}

/// Whether the triangle runs along the edge from its first to its second vertex.
bool runs_forward(const Triangles& triangles, int triangle, const Eigen::RowVector2i& edge) {
  return triangles(triangle, (corner_of(triangles, triangle, edge[0]) + 1) % 3) == edge[1];
}

void count_edges(Diagnosis& diagnosis, const Triangles& triangles, const Edges& edges) {
  std::vector<std::pair<int, int>> boundary;
  for (int e = 0; e < edges.triangles.size(); ++e) {
    const Lists::Range beside = edges.triangles[e];
    const Eigen::RowVector2i edge = edges.vertices.row(e);
    if (beside.size() == 1) note(diagnosis.boundary_edges, edge);
    if (beside.size() == 1) boundary.emplace_back(edge[0], edge[1]);
    if (beside.size() > 2) note(diagnosis.non_manifold_edges, edge);
    if (beside.size() == 2 && runs_forward(triangles, beside[0], edge) == runs_forward(triangles, beside[1], edge)) {
      note(diagnosis.inconsistent_edges, edge);
    }
  }
  const std::vector<int> loop = groups_of(boundary, diagnosis.vertices);
  std::vector<int> loops;
  loops.reserve(boundary.size());
  for (const auto& [first, second] : boundary) loops.push_back(loop[static_cast<size_t>(first)]);
  diagnosis.boundary_loops = count_different(std::move(loops));
}

/// The fan of each corner: corners at one vertex, joined across edges.
std::vector<int> fans(const Triangles& triangles, const Edges& edges) {
  std::vector<std::pair<int, int>> joined;
  for (int e = 0; e < edges.triangles.size(); ++e) {
    const Lists::Range beside = edges.triangles[e];
    for (int i = 1; i < beside.size(); ++i) {
      for (int end : {edges.vertices(e, 0), edges.vertices(e, 1)}) {
        joined.emplace_back(corner_of(triangles, beside[i - 1], end), corner_of(triangles, beside[i], end));
      }
    }
  }
  return groups_of(joined, static_cast<int>(triangles.size()));
}

void count_vertices_with_several_fans(Diagnosis& diagnosis, const Triangles& triangles, const Edges& edges) {
  const std::vector<int> fan = fans(triangles, edges);
  std::vector<int> fan_of_vertex(static_cast<size_t>(diagnosis.vertices), -1);
  std::vector<bool> has_several(static_cast<size_t>(diagnosis.vertices));
  for (size_t c = 0; c < fan.size(); ++c) {
    const auto v = static_cast<size_t>(triangles.data()[c]);
    if (fan_of_vertex[v] < 0) fan_of_vertex[v] = fan[c];
    if (fan_of_vertex[v] != fan[c]) has_several[v] = true;
  }
  for (int v = 0; v < diagnosis.vertices; ++v) {
    if (has_several[static_cast<size_t>(v)]) note(diagnosis.non_manifold_vertices, v);
  }
}

FoundElements duplicate_triangles(const Triangles& triangles) {
  std::vector<std::pair<std::array<int, 3>, int>> rows;  // Sorted vertices, and the triangle.
  rows.reserve(static_cast<size_t>(triangles.rows()));
  for (int t = 0; t < triangles.rows(); ++t) {
    rows.push_back({{triangles(t, 0), triangles(t, 1), triangles(t, 2)}, t});
    std::sort(rows.back().first.begin(), rows.back().first.end());
  }
  std::sort(rows.begin(), rows.end());
  FoundElements found;
  for (size_t i = 1; i < rows.size(); ++i) {
    if (rows[i].first != rows[i - 1].first) continue;
    found.first = found.count++ == 0 ? rows[i].second : std::min(found.first, rows[i].second);
  }
  return found;
}

}  // namespace

Triangles without_repeats(const Triangles& triangles) {
  Triangles kept = triangles;
  Eigen::Index count = 0;
  for (const auto& t : triangles.rowwise()) {
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) kept.row(count++) = t;
  }
  kept.conservativeResize(count, 3);
  return kept;
}

void count_defects(Diagnosis& diagnosis, const Triangles& triangles, const Edges& edges) {
  diagnosis.components = count_components(triangles, diagnosis.vertices);
  count_isolated(diagnosis, triangles);
  count_edges(diagnosis, triangles, edges);
  count_vertices_with_several_fans(diagnosis, triangles, edges);
}

void count_repeats(Diagnosis& diagnosis, const Positions& positions, const Triangles& all, const Triangles& proper) {
  const std::vector<int> firsts = first_at_place(positions);
  diagnosis.duplicate_triangles = duplicate_triangles(welded(all, firsts));
  for (int v = 0; v < diagnosis.vertices; ++v) {
    if (firsts[static_cast<size_t>(v)] != v) note(diagnosis.duplicate_vertices, v);
  }
  diagnosis.welded_components = count_components(welded(proper, firsts), diagnosis.vertices);
}

}  // namespace swage
