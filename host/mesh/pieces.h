// A mesh cut along its creases.
#pragma once

#include <vector>

#include "sides.h"

namespace swage {

/// The triangles of a mesh, in its order, over vertices that are repeated once for each side of a cut, in the order in
/// which triangles have them.
struct Pieces {
  Mesh mesh;
  std::vector<char> on_cut;  ///< Of each vertex of `mesh`: 1 where a cut runs through it or ends there.
};

/// Cuts along edges whose interior dihedral angle is below `crease_angle` (radians), and along those across which
/// there is no telling: of more than two triangles, of triangles that wind against each other, or of one without area.
Pieces cut_at_creases(const Positions& positions, const Triangles& triangles, double crease_angle);

/// The same where its corners and sides are known.
Pieces cut_at_creases(const Positions& positions, const Triangles& triangles, const Lists& corners,
                      const NextSides& next, double crease_angle);

}  // namespace swage
