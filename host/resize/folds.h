// Cells that the trilinear map turns over somewhere.
//
// Johnen, Weill, Remacle: Robust and efficient validation of the linear hexahedral element. International Meshing
// Roundtable 2017: the Jacobian determinant is a polynomial of degree 2 in each direction, and nowhere below the least
// of its 27 Bernstein coefficients.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "grid.h"

namespace swage {

/// Cells in which the determinant, in units of a cell's volume at rest, has a coefficient below `least`: in others it
/// is above everywhere. Axes of no extent are left out.
std::vector<Eigen::Index> folded_cells(const GridShape& shape, const AxisValues& vertices, double least);

}  // namespace swage
