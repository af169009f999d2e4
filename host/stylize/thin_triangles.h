// Triangles that a shape's change would thin out.
#pragma once

#include <vector>

#include "plan.h"

namespace swage {

/// Draws vertices back towards where they started until no triangle has turned by more than 60 degrees since then or by
/// more than a right angle from its normal at rest, nor has an angle below the least, in radians, where it had not as
/// much of that at the start. Fixed vertices stay.
void hold_back(const StylizePlan& plan, const std::vector<char>& is_fixed, double least_angle,
               const Positions& rest_normals, const Positions& start, Positions& positions);

/// Moves vertices of thin triangles towards the mean of their neighbours, across none of the targets of the triangles
/// around, #T × 3: within faces, along edges, at corners not at all. Only where their thinnest triangle gains.
void relax(const StylizePlan& plan, const std::vector<char>& is_fixed, const Positions& targets, Positions& positions);

}  // namespace swage
