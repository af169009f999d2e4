// Any list of triangles as a surface that can be solved on.
#pragma once

#include <vector>

#include "adjacency.h"
#include "swage/mesh.h"

namespace swage {

/// How a surface differs from the mesh it is of.
struct SurfaceCounts {
  int merged = 0;     ///< Vertices that are at another's place.
  int loose = 0;      ///< Vertices that no triangle has.
  int repeated = 0;   ///< Triangles that another before them has the vertices of.
  int collapsed = 0;  ///< Triangles of which two vertices are one.
  int turned = 0;     ///< Triangles that wind the other way.
};

/// A mesh whose vertices at one place are one, whose triangles are there once, and wind alike across edges of two
/// triangles wherever the surface has two sides.
struct Surface {
  Mesh mesh;                             ///< Vertices and triangles in the order given, the first of those alike.
  Edges edges;                           ///< Of the mesh.
  std::vector<int> vertices, triangles;  ///< Of each of the mesh its number as given.
  std::vector<int> vertex_of;            ///< Of each vertex given its number here; -1 where no triangle has it.
  std::vector<int> triangle_of;          ///< The same of triangles; -1 where two of its vertices are one.
  SurfaceCounts counts;

  bool is_as_given() const {
    return vertices.size() == vertex_of.size() && triangles.size() == triangle_of.size() && counts.turned == 0;
  }
};

/// Vertices within `tolerance` of the first of them are one.
Surface surface_of(const Mesh& mesh, double tolerance);

}  // namespace swage
