// Whether a grid's cells turn over, by sampling: independent of how the library proves that they do not.
#pragma once

#include "swage/protective_grid.h"

namespace swage::test {

/// The least determinant of the cells' trilinear maps at 3 × 3 × 3 points each, corners among them, over that of plain
/// scaling by the same factors. Axes of no extent are left out.
double least_determinant(const GridShape& shape, const AxisValues& vertices);

}  // namespace swage::test
