// Directions that elements face.
#pragma once

#include "plan.h"

namespace swage {

/// #N × 3, unit: of triangles their own, of vertices the mean of the triangles around, weighted by area. Zero where
/// there is none.
Positions element_normals(const StylizePlan& plan, const Positions& positions);

/// Of each vertex the sum over the triangles around it.
Positions sums_around(const StylizePlan& plan, const Positions& of_triangles);

}  // namespace swage
