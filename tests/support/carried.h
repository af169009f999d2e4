// What the carry step is asked for.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "swage/steps.h"

namespace swage::test {

/// A mesh with its sides' rings, from its edges.
CarryStep::Rest carried_rest(const Mesh& mesh);

/// Triangles in a grid, with a name each: random ones of all sizes, without area, on cells' faces, in a grid of no
/// extent along an axis, and far outside.
struct GridCase {
  std::string name;
  GridShape shape;
  Mesh mesh;
};
std::vector<GridCase> grid_cases();

/// The cells of each triangle, as the step tells them.
std::vector<std::vector<int>> touched_cells(CarryStep& step, const GridShape& shape, Slice triangles);

/// Fails where a triangle misses a cell that clipping finds, or finds one that clipping with the step's rounding does
/// not.
void expect_touched(CarryStep& step, const GridCase& of);

}  // namespace swage::test
