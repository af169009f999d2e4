// Which sides of triangles run along one edge. Side 3 t + k of triangle t runs from its corner k to corner k + 1.
#pragma once

#include <vector>

#include "adjacency.h"

namespace swage {

/// The side after this one in its triangle, and the one before; of corners likewise.
inline int next_in_triangle(int side) { return side % 3 == 2 ? side - 2 : side + 1; }
inline int previous_in_triangle(int side) { return side % 3 == 0 ? side + 2 : side - 1; }

/// #T × 3: of each side the next along the same edge, ascending, in a ring; one alone is its own next.
using NextSides = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// `corners`: corners_of_vertices(). A side from a vertex to itself is alone.
NextSides next_sides(const Triangles& triangles, const Lists& corners);

/// Whether two sides run the same way along their edge.
inline bool same_way(const Triangles& triangles, int side, int other) {
  const int* const vertices = triangles.data();
  return vertices[side] == vertices[other] && vertices[next_in_triangle(side)] == vertices[next_in_triangle(other)];
}

/// Of each triangle the first with the same three vertices; itself, as a rule.
std::vector<int> firsts_alike(const Triangles& triangles, const Lists& corners);

/// Turns triangles so that neighbours across edges of two wind alike: as the first of each part does. Returns how many;
/// `next` no longer holds where any are. At once where all wind alike already.
int wind_alike(Triangles& triangles, const NextSides& next);

}  // namespace swage
