// A surface as CGAL has it, and the steps from any triangles to a well-shaped one.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <cstdint>
#include <vector>

namespace swage {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Surface = CGAL::Surface_mesh<Point>;
using Vertex = Surface::Vertex_index;
using Edge = Surface::Edge_index;
using HalfEdge = Surface::Halfedge_index;
using Face = Surface::Face_index;
template <class Element, class Value>
using Map = Surface::Property_map<Element, Value>;

/// Triangles over points no two of which are at one place, none with a point twice, no two on the same three.
struct Soup {
  std::vector<Point> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
};

/// Cut where it is not manifold and where no winding agrees: points are repeated there, at their places. Each component
/// winds as most of its area did.
Surface surface_of(Soup soup);

/// An envelope of the triangles: closed, manifold, at `offset` from them, blind to holes narrower than `alpha`.
Surface wrapped(const Soup& soup, double alpha, double offset);

/// Takes out triangles less high than `height` where that leaves the surface's topology, its boundary's copies and the
/// place of what remains.
void drop_slivers(Surface& surface, double height);

/// What has to keep its place.
struct Features {
  Map<Edge, bool> edges;           ///< Creases only: CGAL keeps boundaries anyway, and where named would split those of
                                   ///< faces that it is to leave alone.
  Map<Vertex, bool> vertices;      ///< Where these end, meet or bend.
  Map<Face, std::size_t> patches;  ///< The surface's parts between them.
};

/// Creases turn by more than `angle`, radians. Between two neighbouring `vertices` of a feature line it strays from the
/// straight by at most `tolerance`. All `joined_vertices` are kept, so that copies stay alike.
Features features_of(Surface& surface, double angle, double tolerance);

/// Vertices at a place with others: copies where the surface was cut.
std::vector<Vertex> joined_vertices(const Surface& surface);

struct Sizes {
  double edge_length;
  int iterations;
  std::size_t triangle_limit;  ///< About: no finer edges where more would be needed.
};

/// Isotropic remeshing (Botsch, Kobbelt 2004) by CGAL: to `edge_length`, then to a half, a quarter and an eighth of it
/// around triangles that features or bends do not allow to be well shaped or near the surface at the length before.
void remesh_between(Surface& surface, const Features& features, const Sizes& sizes);

// Of single elements.

inline std::array<Point, 3> corners(const Surface& surface, Face face) {
  const HalfEdge side = surface.halfedge(face);
  return {surface.point(surface.source(side)), surface.point(surface.target(side)),
          surface.point(surface.target(surface.next(side)))};
}

/// Twice the area long.
inline Kernel::Vector_3 area_vector(const Surface& surface, Face face) {
  const auto [a, b, c] = corners(surface, face);
  return CGAL::cross_product(b - a, c - a);
}

inline double twice_area(const Surface& surface, Face face) {
  return CGAL::approximate_sqrt(area_vector(surface, face).squared_length());
}

}  // namespace swage
