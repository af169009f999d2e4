// Which cells of the grid each triangle touches.
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "cancel.h"
#include "swage/backend.h"
#include "swage/protective_grid.h"

namespace swage {

using UseCells = std::function<void(Eigen::Index triangle, std::span<const int> cells)>;

/// Calls `use` for one triangle after the other with the cells it touches, ascending: by any common point, on a cell's
/// boundary as within, up to rounding (CarryStep::count_cells()). So lists of all, which may be long where large
/// triangles cross many cells, are never there at once.
void each_coverage(const GridShape& shape, const std::shared_ptr<const Mesh>& mesh, const Backend& backend,
                   const Poll& poll, const UseCells& use);

}  // namespace swage
