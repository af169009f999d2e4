// Between a mesh as a caller gives it and the surface that is solved: vertices at one place are one there, triangles
// are there once, and of large meshes all are in an order that is near in memory where it is near on the surface (a
// pass at 1.3 million triangles takes half the time).
#pragma once

#include <array>
#include <vector>

#include "holds.h"
#include "numbering.h"
#include "surface.h"
#include "swage/backend.h"
#include "swage/scaffold.h"

namespace swage {

/// "In" and "into" lead to the surface, "back" to what the caller gave.
class Given {
 public:
  /// Puts the surface in order where asked to. Its mesh stays the caller's, who solves it.
  Given(Mesh mesh, Surface& surface, bool in_order);

  const Mesh& mesh() const { return mesh_; }

  /// Without those of vertices that no triangle has; where all are, of the surface nearest to these.
  std::vector<Hold> into(const std::vector<Hold>& holds) const;
  std::vector<int> into(const std::vector<int>& chain) const;
  /// Vertices of no triangle go by the transforms of the surface's triangles. Those at one place are there to a
  /// tolerance only.
  Positions back(const Positions& positions, const Transforms& transforms) const;
  /// A row a vertex, of those of no triangle zero.
  Positions back_vertices(const Positions& rows) const;
  /// #T × 9.
  Transforms back(const Transforms& transforms) const;
  /// Those of a scaffold, whose own points follow the surface's vertices, and then the mesh's as given.
  Tetrahedra back(const Tetrahedra& tetrahedra) const;
  /// Vertices of no triangle that are handles go where they are asked to.
  void place_loose(const Gesture& gesture, Positions& positions) const;

  /// Of each vertex and triangle of the surface the number as given.
  const std::vector<int>& vertices() const { return vertices_; }
  const std::vector<int>& triangles() const { return triangles_; }
  int vertex(int solved) const { return vertices_[static_cast<size_t>(solved)]; }
  int triangle(int solved) const { return triangles_[static_cast<size_t>(solved)]; }
  bool is_loose(int vertex) const { return vertex_of_[static_cast<size_t>(vertex)] < 0; }

 private:
  struct LooseFoot {
    int triangle;
    std::array<int, 3> corners;   ///< Of the triangle, in the surface.
    Eigen::Vector3d barycentric;  ///< Of its nearest point.
    Eigen::RowVector3d offset;    ///< From there.
  };
  struct Loose {
    int vertex;
    std::vector<LooseFoot> feet;  ///< On all triangles that are nearest.
  };

  std::vector<Hold> at_feet(const std::vector<Hold>& holds) const;
  Eigen::RowVector3d aside(int vertex) const;
  void list_loose(const Mesh& surface);
  void find_stand_ins(const Mesh& surface);

  Mesh mesh_;
  std::vector<int> vertices_, triangles_;     ///< Of each of the surface the number as given.
  std::vector<int> vertex_of_, triangle_of_;  ///< Of each given the number in the surface, or -1; of triangles that are
                                              ///< not there one beside them, or -1.
  std::vector<Loose> loose_;                  ///< Vertices of no triangle.
};

/// The surface of any list of triangles. Vertices nearer than what the digits of files keep are one. Throws
/// InvalidInput, naming the `caller`, where no triangle has an area.
Surface surface_given(const Mesh& mesh, const char* caller);

}  // namespace swage
