// Which cells of the grid each triangle touches.
#pragma once

#include <span>
#include <vector>

#include "cancel.h"
#include "swage/backend.h"
#include "swage/protective_grid.h"

namespace swage {

/// Cells of triangle t stand at offsets[t] .. offsets[t + 1], ascending.
struct Coverage {
  std::vector<Eigen::Index> offsets;
  std::vector<int> cells;
};

inline std::span<const int> cells_of(const Coverage& coverage, Eigen::Index triangle) {
  const auto t = static_cast<size_t>(triangle);
  const auto begin = coverage.offsets[t], end = coverage.offsets[t + 1];
  return {coverage.cells.data() + begin, static_cast<size_t>(end - begin)};
}

/// Touching is by any common point, on the cell's boundary as within, up to rounding (1e-9 of a cell).
Coverage coverage(const GridShape& shape, const PositionsRef& positions, const TrianglesRef& triangles,
                  const Backend& backend, const Poll& poll);

}  // namespace swage
