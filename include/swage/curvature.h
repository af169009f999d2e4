// Principal curvatures by local quadric fits.
#pragma once

#include <filesystem>

#include "swage/backend.h"
#include "swage/mesh.h"

#pragma GCC visibility push(default)
namespace swage {

/// #F × 2: principal curvatures k1 >= k2 of each triangle, in 1 / mesh units, positive where the surface bends away
/// from its normal (a sphere of radius r seen from outside has k1 = k2 = 1 / r).
using Curvatures = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

struct CurvatureOptions {
  double crease_angle = 2.5307274153917776;  ///< Interior dihedral angle, radians (145°): the surface is cut into
                                             ///< pieces along sharper edges.
  int rings = 3;                             ///< Neighbourhood of a fit, in edges from the vertex, at least 1.
};

/// Curvature of every triangle: the mean over its vertices off the cuts (all where none is off). A vertex's is that
/// of the quadric z = a x² + b x y + c y² + d x + e y that fits its neighbourhood within its piece best: the
/// flattest of those where one coefficient is undetermined (a tube without inner rings); 0 where more are.
///
/// `backend` does the fits.
///
/// Goldfeather and Interrante 2004 for the fit; Panozzo, Puppo and Rocca 2010 for the neighbourhood.
/// Throws InvalidInput as check() does, and for a crease angle outside [0, pi] or rings below 1.
Curvatures curvature(const PositionsRef& positions, const TrianglesRef& triangles, const CurvatureOptions& options = {},
                     const Backend& backend = *cpu_backend());

/// Reads a `.fk` file: a line a triangle, two principal curvatures of the mesh scaled so that it fits the unit box.
/// Returned as they stand there. Throws UnreadableFile, naming the line, where it has not `triangle_count` lines of
/// two finite numbers.
Curvatures read_unit_box_curvatures(const std::filesystem::path& path, int triangle_count);

}  // namespace swage
#pragma GCC visibility pop
