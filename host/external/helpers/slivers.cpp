// Triangles that are all but lines.
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>

#include <cmath>
#include <numbers>

#include "surface.h"

namespace swage {

void drop_slivers(Surface& surface, double height) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  constexpr double kCap = 170 * std::numbers::pi / 180;  // Largest angle of a triangle to be flipped away,
  constexpr double kNeedle = 5;                          // longest over shortest side of one to be collapsed.
  auto kept = surface.add_property_map<Vertex, bool>("v:joined", false).first;
  for (const Vertex vertex : joined_vertices(surface)) kept[vertex] = true;
  pmp::experimental::remove_almost_degenerate_faces(
      surface, std::cos(kCap), kNeedle, height,
      CGAL::parameters::flip_triangle_height_threshold(height).vertex_is_constrained_map(kept));
  pmp::remove_degenerate_faces(surface);
  surface.remove_property_map(kept);
  surface.collect_garbage();
}

}  // namespace swage
