// What an edit did to a mesh, in numbers.
#pragma once

#include "swage/handles.h"
#include "swage/mesh.h"

namespace swage::test {

/// Angle between the normals at rest and now, degrees, mean over the surface at rest.
double mean_normal_change(const Mesh& rest, const Positions& positions);

/// |log| of the two factors by which each triangle is stretched in its plane, mean over the surface at rest.
double mean_stretch(const Mesh& rest, const Positions& positions);

/// Largest distance of a handle from its target, in box diagonals at rest.
double handle_error(const Mesh& rest, const Gesture& gesture, const Positions& positions);

/// Distances between two edits' first vertices, as many as both have, in box diagonals of the first.
struct Deviation {
  double mean, largest;
};
Deviation deviation(const Positions& one, const Positions& other);

}  // namespace swage::test
