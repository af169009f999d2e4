// Where a polyline is straight.
#pragma once

#include <utility>
#include <vector>

#include "swage/mesh.h"

namespace swage {

/// The straight stretches, as first and last point, of a polyline (a row a point), ascending: not shorter than
/// `shortest`, as long as they are straight, the longest first taken; two share an end at most.
///
/// A stretch of length l in a polyline of length L is straight where it strays from the line between its ends by
/// `deviation` l² / L at most. As an arc of curvature k strays by k l² / 8, an arc's stretches, however short, are
/// straight where all of it would be.
std::vector<std::pair<int, int>> straight_runs(const Positions& points, double deviation, double shortest);

}  // namespace swage
