// What a sphere map says of directions.
#pragma once

#include "swage/backend.h"
#include "swage/style.h"

namespace swage {

/// #N × 3, unit: the style's normals where these unit normals meet the sphere. The backend finds nearest points.
Positions on_sphere(const SphereMap& map, const Positions& normals, const Backend& backend);

/// Where points (unit, #S × 3) and their triangles do not cover the sphere once from outside: triangles that are not
/// seen counter-clockwise.
int folded_triangles(const Positions& directions, const Triangles& triangles);

}  // namespace swage
