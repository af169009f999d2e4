// Vulnerability maps that resizing is tested and timed on, generated.
#pragma once

#include "grid.h"

namespace swage::test {

/// A box from the origin, of cells one unit wide.
GridShape unit_cells(int x, int y, int z);

/// Nothing is vulnerable, and no face touches a cell.
CellMap free_map(const GridShape& shape);
/// All cells along all axes.
CellMap protected_map(const GridShape& shape);
/// Cells by turns.
CellMap checkered_map(const GridShape& shape);
/// One cell in the middle.
CellMap one_cell_map(const GridShape& shape);
/// Half of the values 0, the others anything; faces touch every other cell.
CellMap random_map(const GridShape& shape, unsigned seed);
/// A car: four wheels, a ball in a cabin, a smaller ball, a barrel and walls, as faces would touch cells.
CellMap car_map(const GridShape& shape);
/// A ball about the middle of the grid, of a radius in units of its least size.
CellMap ball_map(const GridShape& shape, double radius);

/// The trilinear map's derivative in a cell, by the points around, relative to plain scaling.
double determinant(const GridShape& shape, const AxisValues& vertices, const Eigen::RowVector3d& at,
                   const Eigen::RowVector3i& cell, const Eigen::RowVector3d& factors);

}  // namespace swage::test
