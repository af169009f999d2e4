// The same surface in well-shaped triangles.
#pragma once

#include <numbers>

#include "swage/mesh.h"
#include "swage/report.h"

#pragma GCC visibility push(default)
namespace swage {

struct RemeshOptions {
  double edge_length = 0;  ///< Mesh units, up to the box diagonal; 0: what `triangles` equilateral triangles of the
                           ///< mesh's area have.
  int triangles = 10'000;  ///< In [100, 1,000,000]. About as many where no feature asks for finer ones, three times as
                           ///< many at most, but for features so dense that they alone need more.
  double feature_angle = std::numbers::pi * 35 / 180;  ///< Between normals, radians, in (0, pi]: an edge where the
                                                       ///< surface turns more is a feature.
  int iterations = 5;  ///< Of splits, collapses, flips and smoothing, at each length; in [1, 100].
  bool wrap = false;   ///< First replace the triangles by an envelope, for those that are no surface of their own.
  double wrap_alpha = 0.02;  ///< Holes up to this width are closed, box diagonals, in [0.002, 1]. The envelope lies a
                             ///< thirtieth of it outside.
  double time_limit = 60;    ///< Seconds, above 0.
};

/// Isotropic remeshing (Botsch, Kobbelt 2004; CGAL) that keeps features: creases, boundaries and edges of more than two
/// triangles. Their corners stay where they are, and between these they stray by at most 0.03 edge lengths. Where
/// features lie too close for well-shaped triangles, or the surface bends too much to be near, edges are down to an
/// eighth as long. What is less than a twentieth of an edge length across may be lost.
///
/// Vertices of the result lie on the surface, save for those of an envelope, and no two at one place; none of its
/// triangles is without area, and it has none twice. It is closed where the mesh, welded, is; where more than two
/// triangles share an edge they still do; a component whose triangles wind against each other is wound as most of its
/// area is. Deterministic.
///
/// Throws InvalidInput where check(positions, triangles) does, no triangle has an area, or an option is out of its
/// range; Unavailable where the build has no CGAL (SWAGE_CGAL) or its program is not found; Unsolvable where that
/// fails, takes too long or too much memory. Where `progress` cancels, the mesh is empty.
Mesh remesh(const PositionsRef& positions, const TrianglesRef& triangles, const RemeshOptions& options = {},
            const ProgressFn& progress = {});

}  // namespace swage
#pragma GCC visibility pop
