// Vertices near each vertex, on its side of the surface.
#pragma once

#include <vector>

#include "adjacency.h"
#include "swage/mesh.h"
#include "swage/steps.h"

namespace swage {

/// What a quadric over each vertex's tangent plane is fitted to: the vertices within `rings` edges that face its way,
/// all where fewer than five do; none of a vertex of triangles without area. Throws InvalidInput where int cannot count
/// them.
CurvatureStep::Rest neighbourhoods(const Mesh& mesh, int rings);

/// The same, of some vertices after others: a large mesh's neighbourhoods are never all there at once.
class Neighbourhoods {
 public:
  /// Keeps `mesh`.
  Neighbourhoods(const Mesh& mesh, int rings);

  /// Unit; 0 of a vertex of triangles without area.
  const Positions& normals() const { return normals_; }
  /// The vertices an edge away from each, ascending.
  const Lists& one_rings() const { return near_; }

  /// Of the vertices of the slice, which come first in it; after them those around, with no neighbours.
  CurvatureStep::Rest of(Slice vertices);

 private:
  /// Of each vertex of the slice, by their numbers in the mesh.
  Lists facing(Slice vertices) const;

  const Mesh& mesh_;
  int rings_;
  Positions normals_;
  Lists near_;
  std::vector<int> places_;  ///< Of each vertex its number in a slice; -1 where it has none.
};

}  // namespace swage
