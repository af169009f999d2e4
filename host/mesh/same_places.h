// Vertices at one place.
#pragma once

#include <vector>

#include "swage/mesh.h"

namespace swage {

/// Of each vertex the first at its place: those within `tolerance` of the first of them are at one place.
std::vector<int> firsts_at_places(const Positions& positions, double tolerance);

}  // namespace swage
