// Constrained Delaunay tetrahedralisation, whoever makes it.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "helper_process.h"
#include "swage/scaffold.h"

namespace swage {

/// What tetrahedra are to fill and what is to be among their faces. No two points are at one place, each is a corner,
/// and no triangle is there twice.
struct Complex {
  Positions points;
  Triangles triangles;
  Eigen::Matrix<int, Eigen::Dynamic, 4, Eigen::RowMajor> quadrilaterals;  ///< The outer boundary.
};

struct Filling {
  Positions points;           ///< The complex's, then Steiner points.
  Tetrahedra tetrahedra;      ///< As Scaffold has them.
  std::vector<int> crossing;  ///< Triangles that cross or overlap others, ascending. Where there are any, no more.
};

/// Whether this build has TetGen, without which tetrahedra_of throws Unavailable.
bool has_tetgen();

/// Puts Steiner points into the inside only; for quality too, else where nothing is possible without them. Throws as
/// run_helper does. What comes back is as the helper says, and not looked at.
Filling tetrahedra_of(const Complex& complex, bool quality, const HelperLimits& limits, const Poll& poll);

}  // namespace swage
