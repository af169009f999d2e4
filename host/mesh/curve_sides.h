// Straight stretches that stand for a curve.
#pragma once

#include <vector>

#include "swage/mesh.h"

namespace swage {

/// Whether each run, a straight row of vertices, is one of three or more in a row that are alike in length, within a
/// factor of two, and turn by less than 35 degrees from one to the next: a side of a polygon that samples a curve.
std::vector<bool> are_sides_of_curves(const PositionsRef& positions, const std::vector<std::vector<int>>& runs);

}  // namespace swage
