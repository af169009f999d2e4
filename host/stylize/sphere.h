// What a sphere map says of directions.
#pragma once

#include "swage/style.h"

namespace swage {

/// #N × 3, unit: the style's normals where these unit normals meet the sphere.
Positions on_sphere(const SphereMap& map, const Positions& normals);

/// Where points (unit, #S × 3) and their triangles do not cover the sphere once from outside: triangles that are not
/// seen counter-clockwise.
int folded_triangles(const Positions& directions, const Triangles& triangles);

}  // namespace swage
