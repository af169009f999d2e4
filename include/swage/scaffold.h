// Tetrahedra around and within a surface, which join its components.
//
// Araújo, Vining, Burla, Ruivo de Oliveira, Rosales, Sheffer: Slippage-Preserving Reshaping of Human-Made 3D Content.
// ACM Transactions on Graphics 42(6), 2023, section 5.1, "Multi-Component Models".
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "swage/mesh.h"
#include "swage/report.h"

#pragma GCC visibility push(default)
namespace swage {

/// #T × 4 vertex indices from 0. Seen from the fourth corner the others run counter-clockwise: det(b - a, c - a, d - a)
/// is positive.
using Tetrahedra = Eigen::Matrix<int, Eigen::Dynamic, 4, Eigen::RowMajor>;
using TetrahedraRef = Eigen::Ref<const Tetrahedra>;

struct ScaffoldOptions {
  double enlargement = 1.5;  ///< Longest side of the box over that of the mesh's box, in [1.01, 1000]. The room around
                             ///< the mesh is the same on all six sides.
  bool quality = false;      ///< Steiner points also for well-shaped tetrahedra, between the surfaces only. They keep
                             ///< components apart that else share edges.
  bool leave_out_crossing = false;  ///< Triangles that cross or overlap others are then no faces; their vertices stay
                                    ///< corners. Else they are refused.
  bool faces = true;       ///< Whether the triangles are faces of it. Else it joins their vertices alone, which
                           ///< suits any surface, and all triangles are left out.
  double time_limit = 60;  ///< Seconds of each of TetGen's runs, above 0. To leave out it may run twice.
};

struct Scaffold {
  Positions positions;        ///< The mesh's #V, as given, then the box's 8 corners, then Steiner points; mesh units.
  Tetrahedra tetrahedra;      ///< They fill the box, within closed components too.
  std::vector<int> left_out;  ///< Of the mesh's triangles those left out as crossing, ascending.
};

/// Constrained Delaunay tetrahedralisation of an axis-aligned box around the mesh, by TetGen (Si 2015). Each triangle
/// is a face of it: no Steiner point lies on the surface, open or not manifold as it may be. Of vertices at one place
/// only the first is a corner, and of triangles on the same three places one counts; vertices of no triangle, and
/// triangles less than 1e-10 of their longest side high, take no part. Deterministic; several may be made at once.
///
/// Throws InvalidInput where check(positions, triangles) does, no triangle has an area, or an option is out of its
/// range; Unavailable where the build has no TetGen (SWAGE_TETGEN) or its program is not found; Unsolvable where
/// triangles cross or overlap and are not to be left out, with the first of them, or TetGen fails, takes too long or
/// too much memory. Where `progress` cancels, the scaffold is empty.
Scaffold scaffold(const PositionsRef& positions, const TrianglesRef& triangles, const ScaffoldOptions& options = {},
                  const ProgressFn& progress = {});

/// Writes tetrahedra by the extension, in any case: .mesh (Medit, ASCII) or .vtk (legacy, ASCII). Doubles read back as
/// they were. Writes beside `path`, then renames. Throws InvalidInput for another extension and for an index outside
/// [0, #V), and UnwritableFile.
void write_tetrahedra(const std::filesystem::path& path, const PositionsRef& positions,
                      const TetrahedraRef& tetrahedra);

}  // namespace swage
#pragma GCC visibility pop
