// Carries an edit from one surface to points near it: from a coarse or remeshed stand-in to the mesh it stands for.
//
// Araújo, Vining, Burla, Ruivo de Oliveira, Rosales, Sheffer: Slippage-Preserving Reshaping of Human-Made 3D Content.
// ACM Transactions on Graphics 42(6), 2023, section 5.1. https://doi.org/10.1145/3618391
#pragma once

#include <Eigen/Core>
#include <optional>

#include "swage/mesh.h"
#include "swage/report.h"
#include "swage/steps.h"

#pragma GCC visibility push(default)
namespace swage {

struct TransferOptions {
  int directions = 16;  ///< Rays a point casts, evenly over the sphere, at most 10,000; 0 for none. Time alone depends
                        ///< on them.
  std::optional<Positions> normals = {};  ///< #P × 3, of the points, of any length: feet are sought on triangles that
                                          ///< face the same way, within 90 degrees, so that the two sides of a thin
                                          ///< part are told apart. A zero row does not care.
  double detour = 4;  ///< How many times as far as the closest foot one on such a triangle may be, at least 1.
};

/// Where points hang on a surface, a row a point.
struct Attachments {
  Eigen::VectorXi triangles;  ///< That the point's foot lies on.
  Positions barycentric;      ///< The foot's coordinates there: none negative, of sum 1.
  Positions offsets;          ///< From the foot to the point, mesh units.
};

/// Hangs each point on the surface by its foot, the closest point of the surface, from either side. As in the paper
/// rays in all directions find the nearest triangle that the point sees, here for a bound: no triangle nearer than the
/// point that they find is passed by. Distances are compared in double precision; of feet exactly as near that on the
/// lowest triangle is taken. Points farther off than 1000 times the surface's size take the foot of a point that near
/// in the same direction. The same bytes from any number of threads.
///
/// Where `progress` cancelled, attachments of no point. It is not called while the surface is prepared: about a second
/// for a million triangles.
/// Throws InvalidInput as check() does, where there are no points, one has a coordinate that check() refuses, normals
/// are not a finite row for each point, or an option is out of its range; Unavailable where the build has no Embree.
Attachments attach(const PositionsRef& points, const PositionsRef& surface_positions,
                   const TrianglesRef& surface_triangles, const TransferOptions& options = {},
                   const ProgressFn& progress = {});

/// Where the points are once the surface's vertices moved from `rest` to `moved`: the foot goes with its triangle, the
/// offset is transformed by that triangle's matrix of `transforms` (#T × 9, such as ReshapeResult::transforms) or,
/// where those are null, by its deformation gradient, which takes its normal to the new one, as long as the square
/// root of the ratio of areas; a triangle nearly without area leaves offsets as they are. Where nothing moved, points
/// are where they were, to rounding.
/// Throws InvalidInput as check() does for the surface at rest and moved, and where attachments or transforms do not
/// fit it or are not finite.
Positions carry(const Attachments& attachments, const TrianglesRef& surface_triangles, const PositionsRef& rest,
                const PositionsRef& moved, const Transforms* transforms = nullptr);

}  // namespace swage
#pragma GCC visibility pop
