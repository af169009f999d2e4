// What an edit changed.
#pragma once

#include <cstddef>
#include <optional>

#include "swage/mesh.h"

namespace swage {

/// Angles in radians, in [0, pi], between the normals of triangles before and after. Weighted by the area before, so
/// that they do not depend on how the surface is cut into triangles; those without area before or after are left out.
struct NormalTurns {
  double mean = 0;
  double percentile_95 = 0;  ///< 95 % of the area turn by no more.
  double max = 0;
  int flipped = 0;  ///< Triangles turned by more than a right angle.
};

NormalTurns normal_turns(const Positions& before, const Positions& after, const Triangles& triangles);

struct CrossingChange {
  int before = 0;  ///< Pairs of triangles that cross.
  int fresh = 0;   ///< That cross after, and not before.
};

/// None where more than `most_pairs` cross before or after.
std::optional<CrossingChange> crossing_change(const Positions& before, const Positions& after,
                                              const Triangles& triangles, std::size_t most_pairs);

}  // namespace swage
