// For what decides by the order of elements or by last digits, as random samples and tetrahedra do: the same mesh
// however it was written down.
#pragma once

#include "numbering.h"

namespace swage {

/// Points by how far they lie along a direction in which no two of a regular mesh are as far.
std::vector<int> by_place(const Positions& points);
/// Vertices so, and triangles by their middles.
Numbering by_place(const Mesh& mesh);

/// Turns each triangle's corners, none over, until its least number stands first.
void begin_with_first(Triangles& triangles);

/// Of a mesh of a size of about 1: without its last digits, unless that brings two points to one place.
Positions rounded(const Positions& points);

}  // namespace swage
