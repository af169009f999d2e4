// What the protective grid's solves share.
#pragma once

#include "swage/protective_grid.h"

namespace swage {

/// No cell's scale or edge is let below this part of what it would be under plain scaling, or at rest where that is
/// less. Edges are let lower than scales: they seldom stop at the bound where the scales did.
constexpr double kLeastScale = 0.1;
constexpr double kLeastEdge = 0.05;

/// Along axes whose cells are chosen.
constexpr int kFewestCells = 5;

/// Throws InvalidInput, naming `caller`, the argument and the cell.
void check(const char* caller, const GridShape& shape, const CellMap& map);
/// Factors along axes of no extent may be anything.
void check_factors(const char* caller, const GridShape& shape, const Eigen::RowVector3d& factors);

}  // namespace swage
