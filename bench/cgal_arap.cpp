#include "cgal_arap.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_deformation.h>

namespace swage::bench {
namespace {

using Point = CGAL::Simple_cartesian<double>::Point_3;
using Surface = CGAL::Surface_mesh<Point>;
using SpokesAndRims = CGAL::Surface_mesh_deformation<Surface, CGAL::Default, CGAL::Default, CGAL::SPOKES_AND_RIMS>;

CGAL::SM_Vertex_index vertex(int i) { return CGAL::SM_Vertex_index(static_cast<CGAL::SM_Vertex_index::size_type>(i)); }

Surface surface_of(const Mesh& mesh) {
  Surface surface;
  for (const auto& p : mesh.positions.rowwise()) surface.add_vertex(Point(p[0], p[1], p[2]));
  for (const auto& t : mesh.triangles.rowwise()) surface.add_face(vertex(t[0]), vertex(t[1]), vertex(t[2]));
  return surface;
}

}  // namespace

struct CgalArap::Parts {
  Surface surface;
  Gesture gesture;
  SpokesAndRims deformation;

  Parts(const Mesh& mesh, const Gesture& asked) : surface(surface_of(mesh)), gesture(asked), deformation(surface) {}
};

CgalArap::CgalArap(const Mesh& mesh, const Gesture& gesture) : parts_(std::make_unique<Parts>(mesh, gesture)) {
  SpokesAndRims& deformation = parts_->deformation;
  deformation.insert_roi_vertices(parts_->surface.vertices().begin(), parts_->surface.vertices().end());
  for (const auto& [i, target] : gesture.targets) deformation.insert_control_vertex(vertex(i));
  deformation.preprocess();
}

CgalArap::~CgalArap() = default;

void CgalArap::solve(int passes) {
  SpokesAndRims& deformation = parts_->deformation;
  deformation.reset();
  for (const auto& [i, target] : parts_->gesture.targets) {
    deformation.set_target_position(vertex(i), Point(target[0], target[1], target[2]));
  }
  deformation.deform(static_cast<unsigned>(passes), 0);
}

}  // namespace swage::bench
