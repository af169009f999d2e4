// Of any triangles a surface.
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>

#include "surface.h"

namespace swage {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

/// Turns around each component that winds against `normals`, one a face, on most of its area.
void wind_like(const std::vector<Kernel::Vector_3>& normals, Surface& surface) {
  auto component = surface.add_property_map<Face, std::size_t>("f:component", 0).first;
  std::vector<double> agreement(pmp::connected_components(surface, component), 0);
  for (const Face face : surface.faces()) {
    const double area = twice_area(surface, face);
    agreement[component[face]] += area_vector(surface, face) * normals[face] < 0 ? -area : area;
  }
  std::vector<Face> turned;
  for (const Face face : surface.faces()) {
    if (agreement[component[face]] < 0) turned.push_back(face);
  }
  pmp::reverse_face_orientations(turned, surface);
  surface.remove_property_map(component);
}

}  // namespace

Surface surface_of(Soup soup) {
  std::vector<Kernel::Vector_3> normals;
  for (const auto& [a, b, c] : soup.triangles) {
    const Point& p = soup.points[static_cast<std::size_t>(a)];
    normals.push_back(CGAL::cross_product(soup.points[static_cast<std::size_t>(b)] - p,
                                          soup.points[static_cast<std::size_t>(c)] - p));
  }
  std::vector<std::vector<std::size_t>> polygons;
  for (const auto& triangle : soup.triangles) polygons.emplace_back(triangle.begin(), triangle.end());
  pmp::orient_polygon_soup(soup.points, polygons);
  Surface surface;
  pmp::polygon_soup_to_polygon_mesh(soup.points, polygons, surface);
  wind_like(normals, surface);
  return surface;
}

}  // namespace swage
