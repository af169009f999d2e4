// A surface without what is there twice or has no area.
#pragma once

#include <vector>

#include "swage/mesh.h"

namespace swage {

/// Triangles that have an area, no two on the same three places, over vertices no two of which are at one place.
struct Distinct {
  std::vector<int> vertices;   ///< Of the mesh, ascending: the first at each place that a triangle uses.
  Triangles triangles;         ///< Corners are places in `vertices`.
  std::vector<int> originals;  ///< Of the mesh's triangles the first that each stands for, ascending.
};

/// A triangle has no area where its height is below 1e-10 of its longest side.
Distinct distinct(const Positions& positions, const Triangles& triangles);

/// For each vertex the first at its place.
std::vector<int> first_at_place(const Positions& positions);

/// The triangles with each vertex replaced by the first one at its place.
Triangles welded(const Triangles& triangles, const std::vector<int>& first_at_place);

}  // namespace swage
