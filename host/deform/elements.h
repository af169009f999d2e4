// What keeps its shape: elements and their edges.
#pragma once

#include <string>
#include <vector>

#include "adjacency.h"
#include "cancel.h"
#include "swage/mesh.h"
#include "swage/scaffold.h"
#include "swage/steps.h"
#include "tie.h"

namespace swage {

struct Elements {
  PairsRest pairs;             ///< Its vertices: the mesh's, then a scaffold's, then a filling's.
  std::vector<int> of_vertex;  ///< An element that has the vertex; of vertices of none, -1.
};

/// #T × 3: half the cotangent of the angle that faces each side; side k joins corners k and k + 1. Of triangles without
/// area, which have none, an equilateral one's.
Positions half_cotangents(const Positions& positions, const Triangles& triangles, const std::vector<char>& is_flat);

/// A triangle's three sides, of the same weight each.
Elements triangle_elements(const Mesh& mesh, double weight);

/// Of each vertex the sides of its triangles, its own and those opposite, by their cotangents: spokes and rims.
Elements vertex_elements(const Mesh& mesh, const std::vector<char>& is_flat);

/// A tetrahedron's six edges, by their cotangents (Chao et al. 2010), and for triangles that are on no tetrahedron the
/// sides by theirs, as a shell of the thickness. `vertices`: the mesh's first.
Elements tetrahedron_elements(const Positions& vertices, const Tetrahedra& tetrahedra, const Triangles& triangles,
                              const std::vector<char>& is_flat, double thickness);

/// The ties as edges, of an element at each end. `vertices`: all that ties are of. Weights follow the elements': a tie
/// of mean edge length and weight 1 is as stiff as a mean edge.
void add_ties(const Positions& vertices, const std::vector<Tie>& ties, double mean_edge_length, Elements& elements);

}  // namespace swage
