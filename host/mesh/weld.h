// A surface whose triangles meet where they touch.
#pragma once

#include "swage/mesh.h"

namespace swage {

/// Vertices at one place made one, in the order of the first at each; without vertices of no triangle, triangles with a
/// vertex twice, and all but the first of triangles on the same three vertices.
Mesh welded(const Positions& positions, const Triangles& triangles);

}  // namespace swage
