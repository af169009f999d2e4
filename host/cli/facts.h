// What is wrong or special with a mesh, in numbers.
#pragma once

#include <optional>

#include "swage/mesh.h"

namespace swage::cli {

struct Facts {
  int vertices = 0;
  int triangles = 0;
  int components = 0;             ///< Isolated vertices left out.
  int boundary_edges = 0;         ///< Edges of one triangle.
  int boundary_loops = 0;         ///< Loops that share a vertex count as one.
  int non_manifold_edges = 0;     ///< Edges of three or more triangles.
  int non_manifold_vertices = 0;  ///< Vertices whose triangles form more than one fan.
  int inconsistent_edges = 0;     ///< Edges whose two triangles run along them in the same direction.
  int degenerate_triangles = 0;   ///< Of no area, or with a vertex twice.
  int duplicate_triangles = 0;    ///< With the three vertices of an earlier one.
  int duplicate_vertices = 0;     ///< At the place of an earlier one.
  int isolated_vertices = 0;      ///< Of no triangle.

  double mean_edge = 0;  ///< Mesh units, as the next two.
  double shortest_edge = 0;
  double longest_edge = 0;
  double smallest_angle = 0;     ///< Of all triangles' corners, radians.
  Eigen::Vector3d low, high;     ///< Corners of the bounding box.
  std::optional<double> volume;  ///< Where the mesh is closed and consistently oriented; negative inside out.
};

/// Takes any mesh that check(positions, triangles) lets pass.
Facts facts_of(const Mesh& mesh);

}  // namespace swage::cli
