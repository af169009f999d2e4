// A slice of a protective grid as flat strips, to be seen along an axis.
#pragma once

#include "swage/resize.h"

namespace swage::cli {

struct GridSlice {
  int axis;           ///< Across it.
  int layer;          ///< Of cells, along the axis.
  int stride = 1;     ///< Lines between which no other is drawn.
  double width = 0;   ///< Of lines, mesh units.
  double height = 0;  ///< Where along the axis they are drawn: seen from above where it is above 0.
};

struct GridLines {
  Mesh mesh;              ///< Two triangles an edge of the grid.
  Eigen::VectorXd theta;  ///< Of each triangle: the most that cells of the slice beside it have, along the line.
};

/// `vertices` as rest_vertices() or ResizeResult::grid have them. More vulnerable edges are drawn over others.
GridLines grid_lines(const GridShape& shape, const CellMap& map, const AxisValues& vertices, const GridSlice& slice);

/// The layer in which most is vulnerable.
int busiest_layer(const GridShape& shape, const CellMap& map, int axis);

}  // namespace swage::cli
