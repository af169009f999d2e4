// What transfers are tried on: a surface with bumps, and points about it.
#pragma once

#include "swage/mesh.h"

namespace swage::test {

/// A closed sphere of radius 1 with bumps and hollows of a tenth, 20 · 4^subdivisions triangles.
Mesh bumpy_sphere(int subdivisions);

/// As many points, in the order of the triangles they are near: `distance` away at most, in mean edge lengths.
Positions points_near(const Mesh& mesh, int count, double distance);

/// The same surface, no two triangles of which share a vertex.
Mesh soup(const Mesh& mesh);

}  // namespace swage::test
