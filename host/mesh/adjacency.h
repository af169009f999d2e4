// Which elements of a mesh lie beside which.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "swage/mesh.h"

namespace swage {

/// For each of n things a list of ints.
struct Lists {
  std::vector<int> offsets;
  std::vector<int> items;

  int size() const { return static_cast<int>(offsets.size()) - 1; }
  struct Range {
    const int* first;
    const int* last;
    const int* begin() const { return first; }
    const int* end() const { return last; }
    int size() const { return static_cast<int>(last - first); }
    int operator[](int i) const { return first[i]; }
  };
  Range operator[](int i) const {
    const auto at = static_cast<size_t>(i);
    return {items.data() + offsets[at], items.data() + offsets[at + 1]};
  }
};

/// Lists of `count` things from pairs (thing, item): items in the order given.
Lists lists_from(int count, const std::vector<std::pair<int, int>>& pairs);

struct Edges {
  Eigen::Matrix<int, Eigen::Dynamic, 2, Eigen::RowMajor> vertices;        ///< #E × 2, first below second, ascending.
  Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor> triangle_edges;  ///< #T × 3: k joins corners k and k + 1.
  Lists triangles;                                                        ///< Triangles beside each edge, ascending.
};

Edges edges_of(const Triangles& triangles);

/// The edge between two vertices, in either order; -1 where none is.
int edge_between(const Edges& edges, int a, int b);

/// Whether the triangle runs along the edge from its first vertex to its second.
bool runs_along(const Triangles& triangles, int triangle, const Eigen::RowVector2i& edge);

/// Triangles around each vertex, ascending.
Lists triangles_of_vertices(const Triangles& triangles, int vertex_count);

/// Corners of triangles at each vertex, ascending: 3 t + k is corner k of triangle t.
Lists corners_of_vertices(const Triangles& triangles, int vertex_count);

/// The vertices joined to each vertex by an edge, ascending.
Lists one_rings(const Edges& edges, int vertex_count);

/// Connected component of each vertex, numbered in the order of their first vertices. A vertex of no triangle is a
/// component of its own.
std::vector<int> components(const Triangles& triangles, int vertex_count);

}  // namespace swage
