// Which cells of a grid a triangle touches, by clipping it: independent of separating axes.
#pragma once

#include <vector>

#include "swage/protective_grid.h"

namespace swage::test {

/// All cells, each wider by `margin` of its width to all sides, of which the triangle has a point; ascending. Corners:
/// a row each.
std::vector<int> cells_by_clipping(const GridShape& shape, const Eigen::Matrix3d& corners, long double margin);

}  // namespace swage::test
