// Vertices near each vertex, on its side of the surface.
#pragma once

#include "swage/mesh.h"
#include "swage/steps.h"

namespace swage {

/// What a quadric over each vertex's tangent plane is fitted to: the vertices within `rings` edges that face its way,
/// all where fewer than five do; none of a vertex of triangles without area. Throws InvalidInput where int cannot count
/// them.
CurvatureStep::Rest neighbourhoods(const Mesh& mesh, int rings);

}  // namespace swage
