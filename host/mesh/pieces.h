// A mesh cut along its creases.
#pragma once

#include <vector>

#include "swage/mesh.h"

namespace swage {

/// The triangles of a mesh, in its order, over vertices that are repeated once for each side of a cut.
struct Pieces {
  Mesh mesh;
  std::vector<bool> on_cut;  ///< Of each vertex of `mesh`: whether a cut runs through it or ends there.
};

/// Cuts along edges whose interior dihedral angle is below `crease_angle` (radians), and along those across which
/// there is no telling: of more than two triangles, of triangles that wind against each other, or of one without area.
Pieces cut_at_creases(const Positions& positions, const Triangles& triangles, double crease_angle);

}  // namespace swage
