// The protective grid: the box of a model cut into cells, and how vulnerable each cell is.
//
// Kraevoy, Sheffer, Shamir, Cohen-Or: Non-Homogeneous Resizing of Complex Models. SIGGRAPH Asia 2008, section 4.
#pragma once

#include <Eigen/Core>
#include <array>

#include "swage/mesh.h"

#pragma GCC visibility push(default)
namespace swage {

/// A row a triangle, a cell or a vertex of the grid; a column an axis.
using AxisValues = Positions;

/// Extents of an array whose x runs fastest.
struct Extents {
  std::array<int, 3> counts;

  int operator[](int axis) const { return counts[static_cast<size_t>(axis)]; }
  int& operator[](int axis) { return counts[static_cast<size_t>(axis)]; }
  Eigen::Index stride(int axis) const {
    return axis == 0 ? 1 : axis == 1 ? counts[0] : Eigen::Index{counts[0]} * counts[1];
  }
  Eigen::Index count() const { return stride(2) * counts[2]; }
  Eigen::Index at(int i, int j, int k) const { return i + counts[0] * (j + Eigen::Index{counts[1]} * k); }
};

/// An axis-aligned box cut into cells of one size. A flat box has one cell along the axis in which it has no extent.
struct GridShape {
  Extents cells;              ///< At least 1 along each axis.
  Eigen::RowVector3d corner;  ///< The lowest, in mesh units.
  Eigen::RowVector3d size;    ///< At least 0.

  Extents vertices() const { return {{cells[0] + 1, cells[1] + 1, cells[2] + 1}}; }  ///< Of the grid.
  bool extends(int axis) const { return size[axis] > 0; }  ///< Whether the box is not flat there.
};

/// What is to be protected.
struct CellMap {
  AxisValues theta;     ///< #C × 3: vulnerability along each axis, in [0, 1].
  Eigen::VectorXd phi;  ///< #C: what deforming a cell out of step with its neighbours costs, in [0.001, 1000].
};

/// Vertices of the box at rest, #(nx+1)(ny+1)(nz+1) × 3.
AxisValues rest_vertices(const GridShape& shape);

}  // namespace swage
#pragma GCC visibility pop
