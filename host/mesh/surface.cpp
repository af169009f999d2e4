#include "surface.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "same_places.h"

namespace swage {
namespace {

/// Of each triangle whether another before it has the same three vertices.
std::vector<char> repeats(const Triangles& triangles, const Edges& edges) {
  std::vector<char> is_repeated(static_cast<size_t>(triangles.rows()), 0);
  for (int e = 0; e < edges.triangles.size(); ++e) {
    const Lists::Range beside = edges.triangles[e];
    const auto opposite = [&](int t) { return triangles.row(t).sum() - edges.vertices.row(e).sum(); };
    for (int i = 1; i < beside.size(); ++i) {
      for (int j = 0; j < i && is_repeated[static_cast<size_t>(beside[i])] == 0; ++j) {
        if (opposite(beside[i]) == opposite(beside[j])) is_repeated[static_cast<size_t>(beside[i])] = 1;
      }
    }
  }
  return is_repeated;
}

/// Of `kept` triangles, those that are not left out.
void leave_out(const std::vector<char>& left_out, std::vector<int>& kept) {
  size_t count = 0;
  for (size_t i = 0; i < kept.size(); ++i) {
    if (left_out[i] == 0) kept[count++] = kept[i];
  }
  kept.resize(count);
}

void number_vertices(const std::vector<int>& firsts, const Triangles& joined, Surface& surface) {
  std::vector<char> is_used(firsts.size(), 0);
  for (const int t : surface.triangles) {
    for (int k = 0; k < 3; ++k) is_used[static_cast<size_t>(joined(t, k))] = 1;
  }
  surface.vertex_of.assign(firsts.size(), -1);
  for (size_t v = 0; v < firsts.size(); ++v) {
    const auto first = static_cast<size_t>(firsts[v]);
    if (is_used[first] == 0) {
      ++surface.counts.loose;
    } else if (first == v) {
      surface.vertex_of[v] = static_cast<int>(surface.vertices.size());
      surface.vertices.push_back(static_cast<int>(v));
    } else {
      surface.vertex_of[v] = surface.vertex_of[first];
      ++surface.counts.merged;
    }
  }
}

/// Of each triangle given the one with its vertices that is kept.
void number_triangles(const Triangles& joined, Surface& surface) {
  surface.triangle_of.assign(static_cast<size_t>(joined.rows()), -1);
  for (size_t t = 0; t < surface.triangles.size(); ++t) {
    surface.triangle_of[static_cast<size_t>(surface.triangles[t])] = static_cast<int>(t);
  }
  if (surface.counts.repeated == 0) return;
  const auto corners = [&](int t) {
    std::array<int, 3> sorted{joined(t, 0), joined(t, 1), joined(t, 2)};
    std::sort(sorted.begin(), sorted.end());
    return sorted;
  };
  std::vector<int> order(static_cast<size_t>(joined.rows()));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return std::pair(corners(a), a) < std::pair(corners(b), b); });
  for (size_t i = 1; i < order.size(); ++i) {
    if (corners(order[i]) != corners(order[i - 1])) continue;
    surface.triangle_of[static_cast<size_t>(order[i])] = surface.triangle_of[static_cast<size_t>(order[i - 1])];
  }
}

/// Turns triangles, and their edges with them, so that neighbours wind alike: as the first of each part does.
int wind_alike(Triangles& triangles, Edges& edges) {
  std::vector<char> is_met(static_cast<size_t>(triangles.rows()), 0);
  std::vector<int> walk;
  int turned = 0;
  for (int first = 0; first < triangles.rows(); ++first) {
    if (std::exchange(is_met[static_cast<size_t>(first)], 1) != 0) continue;
    walk.assign(1, first);
    for (size_t next = 0; next < walk.size(); ++next) {
      const int t = walk[next];
      for (const int e : Eigen::RowVector3i(edges.triangle_edges.row(t))) {
        const Lists::Range beside = edges.triangles[e];
        if (beside.size() != 2) continue;
        const int other = beside[0] == t ? beside[1] : beside[0];
        if (std::exchange(is_met[static_cast<size_t>(other)], 1) != 0) continue;
        walk.push_back(other);
        const Eigen::RowVector2i edge = edges.vertices.row(e);
        if (runs_along(triangles, t, edge) != runs_along(triangles, other, edge)) continue;
        std::swap(triangles(other, 1), triangles(other, 2));
        std::swap(edges.triangle_edges(other, 0), edges.triangle_edges(other, 2));
        ++turned;
      }
    }
  }
  return turned;
}

}  // namespace

Surface surface_of(const Mesh& mesh, double tolerance) {
  Surface surface;
  const std::vector<int> firsts = firsts_at_places(mesh.positions, tolerance);
  const Triangles joined = mesh.triangles.unaryExpr([&](int v) { return firsts[static_cast<size_t>(v)]; });
  for (int t = 0; t < joined.rows(); ++t) {
    const bool is_one = joined(t, 0) != joined(t, 1) && joined(t, 1) != joined(t, 2) && joined(t, 2) != joined(t, 0);
    is_one ? surface.triangles.push_back(t) : void(++surface.counts.collapsed);
  }
  const Triangles whole = joined(surface.triangles, Eigen::all);
  surface.edges = edges_of(whole);
  const std::vector<char> repeated = repeats(whole, surface.edges);
  surface.counts.repeated = static_cast<int>(std::count(repeated.begin(), repeated.end(), 1));
  leave_out(repeated, surface.triangles);
  number_vertices(firsts, joined, surface);
  number_triangles(joined, surface);
  surface.mesh.positions = mesh.positions(surface.vertices, Eigen::all);
  surface.mesh.triangles =
      joined(surface.triangles, Eigen::all).unaryExpr([&](int v) { return surface.vertex_of[static_cast<size_t>(v)]; });
  const bool is_whole = surface.mesh.triangles.rows() == whole.rows() && surface.mesh.triangles == whole;
  if (!is_whole) surface.edges = edges_of(surface.mesh.triangles);
  surface.counts.turned = wind_alike(surface.mesh.triangles, surface.edges);
  return surface;
}

}  // namespace swage
