// The elements of shells: triangles, and vertices with their spokes and rims (Chao, Pinkall, Sanan, Schröder: A Simple
// Geometric Model for Elastic Deformations. SIGGRAPH 2010).
#pragma once

#include <vector>

#include "adjacency.h"
#include "element_list.h"
#include "swage/mesh.h"

namespace swage {

/// #T × 3: half the cotangent of the angle that faces each side; side k joins corners k and k + 1. Of triangles without
/// area, which have none, an equilateral one's.
Positions half_cotangents(const Positions& positions, const Triangles& triangles, const std::vector<char>& is_flat);

/// A triangle's three sides, of the weights of its row: #T × 3, or one row for all.
Elements triangle_elements(const Mesh& mesh, const Positions& weights);

/// Of each vertex the sides of its triangles, its own and those opposite, of the triangles' weights, #T × 3.
Elements vertex_elements(const Mesh& mesh, const Positions& weights);
/// By their cotangents.
Elements vertex_elements(const Mesh& mesh, const std::vector<char>& is_flat);

/// Adds the sides of triangles around a vertex.
void add_star(const Triangles& triangles, const Positions& weights, const Lists::Range& around, double factor,
              ElementList& list);

}  // namespace swage
