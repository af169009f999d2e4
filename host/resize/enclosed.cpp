#include "enclosed.h"

#include <algorithm>
#include <vector>

#include "grid.h"

namespace swage {
namespace {

using Eigen::Index;

constexpr double kWall = 0.1;  // Vulnerability of cells that enclose others.

/// Cells of one place along an axis.
struct CellSlice {
  Index first, across, up;  ///< Its first cell, and strides along its two axes.
  int width, height;

  Index cell(int i, int j) const { return first + i * across + j * up; }
};

/// Of each cell of a slice, column after column, whether it is reached from the slice's border without passing a wall.
template <typename IsWall>
std::vector<char> reached_from_border(const CellSlice& slice, const IsWall& is_wall) {
  std::vector<char> reached(static_cast<size_t>(slice.width) * static_cast<size_t>(slice.height), 0);
  std::vector<std::array<int, 2>> front;
  const auto reach = [&](int i, int j) {
    if (i < 0 || j < 0 || i >= slice.width || j >= slice.height || is_wall(slice.cell(i, j))) return;
    char& seen = reached[static_cast<size_t>(i) * static_cast<size_t>(slice.height) + static_cast<size_t>(j)];
    if (seen == 0) front.push_back({i, j});
    seen = 1;
  };
  for (int i = 0; i < slice.width; ++i) {
    reach(i, 0);
    reach(i, slice.height - 1);
  }
  for (int j = 0; j < slice.height; ++j) {
    reach(0, j);
    reach(slice.width - 1, j);
  }
  while (!front.empty()) {
    const auto [i, j] = front.back();
    front.pop_back();
    reach(i - 1, j);
    reach(i + 1, j);
    reach(i, j - 1);
    reach(i, j + 1);
  }
  return reached;
}

}  // namespace

void protect_enclosed(const GridShape& shape, CellMap& map) {
  const AxisValues found = map.theta;
  for (int w = 0; w < 3; ++w) {
    const int u = (w + 1) % 3, v = (w + 2) % 3;
    const auto is_wall = [&](Index c) { return std::min(found(c, u), found(c, v)) >= kWall; };
    for (int k = 0; k < shape.cells[w]; ++k) {
      const CellSlice slice = {k * shape.cells.stride(w), shape.cells.stride(u), shape.cells.stride(v), shape.cells[u],
                               shape.cells[v]};
      const std::vector<char> outside = reached_from_border(slice, is_wall);
      auto at = outside.begin();
      for (int i = 0; i < slice.width; ++i) {
        for (int j = 0; j < slice.height; ++j) {
          const Index c = slice.cell(i, j);
          if (*at++ == 0 && !is_wall(c)) map.theta(c, u) = map.theta(c, v) = 1;
        }
      }
    }
  }
}

}  // namespace swage
