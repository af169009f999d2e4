// Another order for a mesh's elements: what is near on the surface is near in memory.
#pragma once

#include <vector>

#include "adjacency.h"
#include "swage/mesh.h"

namespace swage {

struct Numbering {
  std::vector<int> vertices, triangles;  ///< Of each place the number it has in the mesh.
};

/// Vertices as a breadth-first walk along edges meets them, from the first of each component on; triangles by their
/// first vertices.
Numbering by_neighbourhood(const Mesh& mesh, const Edges& edges);

/// Of each number its place, from the number of each place.
std::vector<int> inverse(const std::vector<int>& numbers);

/// Vertices and triangles in this order, each triangle's corners in their own.
Mesh in_order(const Mesh& mesh, const Numbering& numbering);

}  // namespace swage
