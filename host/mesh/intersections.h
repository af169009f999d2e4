// Where a mesh crosses itself.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "swage/mesh.h"

namespace swage {

struct Crossings {
  std::vector<std::array<int, 2>> pairs;  ///< Of triangles, first below second, ascending.
  bool complete = true;                   ///< False where there are, or may be, more.
};

/// All pairs of triangles that have a point in common beyond the vertex or the edge that they share, decided exactly.
/// Vertices at one place are one. Two triangles of the same three vertices cross; a triangle whose corners are exactly
/// collinear crosses nothing. Where more than `most_pairs` are found, the search ends with as many. Deterministic, for
/// any number of threads. `goes_on` is asked every few hundredths of a second once the search has begun (half a second
/// at a million triangles), with the part done; the answer no ends it with what is found.
Crossings self_intersections(const Positions& positions, const Triangles& triangles, std::size_t most_pairs,
                             const std::function<bool(double)>& goes_on = {});

}  // namespace swage
