#include "grid_lines.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace swage::cli {
namespace {

using Eigen::Index;
using Eigen::RowVector3d;

constexpr double kRise = 0.1;  // Widths that the most vulnerable edges are above others.

/// From a vertex to the next along an axis.
struct Edge {
  int along, across;
  int i, k;  ///< Of the vertex, along and across.
};

std::vector<Edge> edges_of(const GridShape& shape, const GridSlice& slice) {
  std::vector<Edge> edges;
  for (int along = 0; along < 3; ++along) {
    if (along == slice.axis || !shape.extends(along)) continue;
    const int across = 3 - along - slice.axis;
    for (int k = 0; k <= shape.cells[across]; ++k) {
      if (k % slice.stride != 0 && k != shape.cells[across]) continue;
      for (int i = 0; i < shape.cells[along]; ++i) edges.push_back({along, across, i, k});
    }
  }
  return edges;
}

/// Where lines are left out, of all cells up to the next that are drawn.
double theta_beside(const GridShape& shape, const CellMap& map, const GridSlice& slice, const Edge& edge) {
  const Extents& cells = shape.cells;
  const int first = edge.i / slice.stride * slice.stride;
  double theta = 0;
  for (int i = first; i < std::min(cells[edge.along], first + slice.stride); ++i) {
    for (int k = std::max(0, edge.k - slice.stride); k < std::min(cells[edge.across], edge.k + slice.stride); ++k) {
      const Index cell =
          slice.layer * cells.stride(slice.axis) + i * cells.stride(edge.along) + k * cells.stride(edge.across);
      theta = std::max(theta, map.theta(cell, edge.along));
    }
  }
  return theta;
}

}  // namespace

GridLines grid_lines(const GridShape& shape, const CellMap& map, const AxisValues& vertices, const GridSlice& slice) {
  const std::vector<Edge> edges = edges_of(shape, slice);
  const auto count = static_cast<Index>(edges.size());
  const Extents grid = shape.vertices();
  GridLines lines{{Positions(4 * count, 3), Triangles(2 * count, 3)}, Eigen::VectorXd(2 * count)};
  for (Index e = 0; e < count; ++e) {
    const Edge& edge = edges[static_cast<size_t>(e)];
    const double theta = theta_beside(shape, map, slice, edge);
    const Index first =
        slice.layer * grid.stride(slice.axis) + edge.i * grid.stride(edge.along) + edge.k * grid.stride(edge.across);
    const RowVector3d aside = slice.width / 2 * RowVector3d::Unit(edge.across);
    for (const int end : {0, 1}) {
      const RowVector3d at = vertices.row(first + end * grid.stride(edge.along));
      lines.mesh.positions.row(4 * e + 2 * end) = at - aside;
      lines.mesh.positions.row(4 * e + 2 * end + 1) = at + aside;
    }
    lines.mesh.positions.col(slice.axis)
        .segment(4 * e, 4)
        .setConstant(slice.height + std::copysign(kRise * slice.width * theta, slice.height));
    const auto a = static_cast<int>(4 * e);
    lines.mesh.triangles.row(2 * e) << a, a + 1, a + 3;
    lines.mesh.triangles.row(2 * e + 1) << a, a + 3, a + 2;
    lines.theta.segment(2 * e, 2).setConstant(theta);
  }
  return lines;
}

int busiest_layer(const GridShape& shape, const CellMap& map, int axis) {
  std::vector<double> sums(static_cast<size_t>(shape.cells[axis]), 0);
  for (Index c = 0; c < shape.cells.count(); ++c) {
    sums[static_cast<size_t>(c / shape.cells.stride(axis) % shape.cells[axis])] += map.theta.row(c).sum();
  }
  // Of several the last, which is seen from the front.
  return static_cast<int>(sums.rend() - std::max_element(sums.rbegin(), sums.rend())) - 1;
}

}  // namespace swage::cli
