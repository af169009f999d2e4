// The intrinsic Delaunay triangulation of a surface: its own vertices and shape, but sides that may run straight across
// triangles as the surface is unfolded, where no circle about a triangle holds the vertex beyond a side.
//
// Fisher, Springborn, Schröder, Bobenko: An Algorithm for the Construction of Intrinsic Delaunay Triangulations with
// Applications to Digital Geometry Processing. Computing 81(2-3), 2007.
#pragma once

#include <vector>

#include "adjacency.h"
#include "swage/mesh.h"

namespace swage {

struct IntrinsicTriangles {
  Triangles triangles;  ///< As many as the mesh's. Two may share two sides, and a side may join a vertex to itself.
  Positions lengths;    ///< #T × 3: side k joins corners k and k + 1.
};

/// Flips sides of two triangles that wind alike until the angles opposite each sum to pi at most. Boundaries, sides of
/// three triangles and more, and flat triangles stay.
IntrinsicTriangles intrinsic_delaunay(const Mesh& mesh, const Edges& edges, const std::vector<char>& is_flat);

/// #T × 3: half the cotangent of the angle that faces each side. Of flat triangles an equilateral one's.
Positions half_cotangents(const Positions& lengths, const std::vector<char>& is_flat);

}  // namespace swage
