// Triangles of no area to speak of.
#pragma once

#include <vector>

#include "adjacency.h"
#include "swage/mesh.h"

namespace swage {

/// Of each triangle whether its height is below 1e-5 of its longest side, where the digits that files keep decide
/// which way it faces.
std::vector<char> flat_triangles(const Positions& positions, const Triangles& triangles);

/// #T × 3, unit: of flat triangles as near to their neighbours' as their longest side allows. Triangles wind alike.
Positions lent_normals(const Positions& positions, const Triangles& triangles, const Edges& edges,
                       const std::vector<char>& is_flat);

}  // namespace swage
