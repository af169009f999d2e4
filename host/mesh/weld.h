// Vertices at one place.
#pragma once

#include <vector>

#include "swage/mesh.h"

namespace swage {

/// Of each vertex the first one with the same coordinates.
std::vector<int> first_at_place(const Positions& positions);

/// The triangles with each vertex replaced by the first one at its place.
Triangles welded(const Triangles& triangles, const std::vector<int>& first_at_place);

}  // namespace swage
