// Which neighbours' maps are joined, and how firmly (paper eq. 14, 18).
#pragma once

#include "adjacency.h"
#include "swage/steps.h"

namespace swage {

/// Fills offsets, neighbours and weights of `rest` from its pairs and normals: of a vertex those an edge away, by
/// exp(-d² / sigma²), d how far they lie off the plane across its normal. All together count as much as the vertex's
/// own edges. Not across `features`, edges that are sharp: along them alone.
void join_neighbours(const Edges& edges, const std::vector<char>& is_feature, double sigma, LocalMapStep::Rest& rest);

}  // namespace swage
