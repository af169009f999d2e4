// The elements of a filling, and of what joins components.
#pragma once

#include <vector>

#include "element_list.h"
#include "swage/mesh.h"
#include "swage/scaffold.h"
#include "tie.h"

namespace swage {

/// A tetrahedron's six edges, by their cotangents (Chao et al. 2010), and for triangles that are on no tetrahedron the
/// sides by theirs, as a shell of the thickness. `vertices`: the mesh's first.
Elements tetrahedron_elements(const Positions& vertices, const Tetrahedra& tetrahedra, const Triangles& triangles,
                              const std::vector<char>& is_flat, double thickness);

/// The ties as edges, of an element at each end. `vertices`: all that ties are of. Weights follow the elements': a tie
/// of mean edge length and weight 1 is as stiff as a mean edge.
void add_ties(const Positions& vertices, const std::vector<Tie>& ties, double mean_edge_length, Elements& elements);

}  // namespace swage
