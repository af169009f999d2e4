// Tetrahedra within a surface.
#pragma once

#include <vector>

#include "cancel.h"
#include "swage/mesh.h"
#include "swage/scaffold.h"

namespace swage {

/// Of each tetrahedron whether its middle is within a component of the surface: whether two of three lines through it
/// cross one component an odd number of times on either side. So nothing is within an open sheet, all is within a
/// surface with small holes, and which way triangles wind does not matter.
std::vector<char> are_inside(const Mesh& surface, const Positions& vertices, const Tetrahedra& tetrahedra,
                             const Poll& poll);

}  // namespace swage
