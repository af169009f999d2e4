// The grid as a surface.
#include "swage/resize.h"

#include <array>
#include <map>

#include "grid.h"
#include "swage/error.h"

namespace swage {
namespace {

using Eigen::Index;

/// Corners of the face of a cell across `axis`, at its upper end or its lower, counter-clockwise from outside.
std::array<Index, 4> face_of(const Extents& grid, const std::array<int, 3>& cell, int axis, bool upper) {
  const Index a = grid.stride((axis + 1) % 3), b = grid.stride((axis + 2) % 3);
  const Index first = grid.at(cell[0], cell[1], cell[2]) + (upper ? grid.stride(axis) : 0);
  if (upper) return {first, first + a, first + a + b, first + b};
  return {first, first + b, first + a + b, first + a};
}

}  // namespace

Mesh grid_surface(const GridShape& shape, const CellMap& map, const AxisValues& vertices, std::vector<int>* cells) {
  check("grid_surface", shape, map);
  const Extents grid = shape.vertices();
  if (vertices.rows() != grid.count()) {
    throw InvalidInput("grid_surface: vertices: " + std::to_string(vertices.rows()) + " rows, but the grid has " +
                       std::to_string(grid.count()) + " vertices; give one for each");
  }
  std::vector<int> bounded, corners;
  std::vector<int> numbers(static_cast<size_t>(grid.count()), -1);
  std::vector<Index> used;
  const auto number = [&](Index vertex) {
    int& own = numbers[static_cast<size_t>(vertex)];
    if (own < 0) {
      own = static_cast<int>(used.size());
      used.push_back(vertex);
    }
    return own;
  };
  const auto touched = [&](const std::array<int, 3>& at) { return map.phi[shape.cells.at(at[0], at[1], at[2])] == 1; };
  for (Index c = 0; c < shape.cells.count(); ++c) {
    const std::array<int, 3> at = {static_cast<int>(c % shape.cells[0]),
                                   static_cast<int>(c / shape.cells[0] % shape.cells[1]),
                                   static_cast<int>(c / shape.cells.stride(2))};
    if (!touched(at)) continue;
    for (int axis = 0; axis < 3; ++axis) {
      for (const bool upper : {false, true}) {
        std::array<int, 3> beside = at;
        int& along = beside[static_cast<size_t>(axis)];
        along += upper ? 1 : -1;
        if (along >= 0 && along < shape.cells[axis] && touched(beside)) continue;
        const std::array<Index, 4> face = face_of(grid, at, axis, upper);
        for (const size_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) corners.push_back(number(face[corner]));
        bounded.insert(bounded.end(), 2, static_cast<int>(c));
      }
    }
  }
  Mesh mesh{vertices(used, Eigen::all), Triangles(static_cast<Index>(bounded.size()), 3)};
  std::copy(corners.begin(), corners.end(), mesh.triangles.data());
  if (cells != nullptr) *cells = std::move(bounded);
  return mesh;
}

}  // namespace swage
