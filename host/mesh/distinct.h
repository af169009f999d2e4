// A surface without what is there twice.
#pragma once

#include <vector>

#include "swage/mesh.h"

namespace swage {

/// Triangles no two of which are on the same three places, over vertices no two of which are at one place.
struct Distinct {
  std::vector<int> vertices;   ///< Of the mesh, ascending: the first at each place that a triangle uses.
  Triangles triangles;         ///< Corners are places in `vertices`.
  std::vector<int> originals;  ///< Of the mesh's triangles the first that each stands for, ascending.
};

enum class FlatTriangles { dropped, kept };

/// Without triangles that name a place twice, and those that have no area (has_area) unless they are kept.
Distinct distinct(const Positions& positions, const Triangles& triangles, FlatTriangles flat = FlatTriangles::dropped);

/// For each vertex the first at its place.
std::vector<int> first_at_place(const Positions& positions);

/// The triangles with each vertex replaced by the first one at its place.
Triangles welded(const Triangles& triangles, const std::vector<int>& first_at_place);

}  // namespace swage
