// The elements of a filling.
#pragma once

#include <vector>

#include "element_list.h"
#include "swage/mesh.h"
#include "swage/scaffold.h"

namespace swage {

/// A tetrahedron's six edges, by their cotangents (Chao et al. 2010), and for triangles that are on no tetrahedron the
/// sides by theirs, as a shell of the thickness. `vertices`: the mesh's first.
Elements tetrahedron_elements(const Positions& vertices, const Tetrahedra& tetrahedra, const Triangles& triangles,
                              const std::vector<char>& is_flat, double thickness);

}  // namespace swage
