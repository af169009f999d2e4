#include "cgal_arap.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_deformation.h>

#include "swage/error.h"

namespace swage::test {
namespace {

using Point = CGAL::Simple_cartesian<double>::Point_3;
using Surface = CGAL::Surface_mesh<Point>;
using SpokesAndRims = CGAL::Surface_mesh_deformation<Surface, CGAL::Default, CGAL::Default, CGAL::SPOKES_AND_RIMS>;

CGAL::SM_Vertex_index vertex(int i) { return CGAL::SM_Vertex_index(static_cast<CGAL::SM_Vertex_index::size_type>(i)); }

Surface surface_of(const Mesh& mesh) {
  Surface surface;
  for (const auto& p : mesh.positions.rowwise()) surface.add_vertex(Point(p[0], p[1], p[2]));
  for (const auto& t : mesh.triangles.rowwise()) {
    if (surface.add_face(vertex(t[0]), vertex(t[1]), vertex(t[2])) == Surface::null_face()) {
      throw Unsolvable("CGAL takes the mesh for no manifold");
    }
  }
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
  if (!deformation.preprocess()) throw Unsolvable("CGAL finds the system singular");
}

CgalArap::~CgalArap() = default;

void CgalArap::solve(int passes) {
  SpokesAndRims& deformation = parts_->deformation;
  deformation.reset();
  for (const auto& [i, target] : parts_->gesture.targets) {
    deformation.set_target_position(vertex(i), Point(target[0], target[1], target[2]));
  }
  deformation.deform(static_cast<unsigned>(passes), 0);  // No tolerance: all passes, and no energy computed in between.
}

Positions CgalArap::positions() const {
  const Surface& surface = parts_->surface;
  Positions result(static_cast<Eigen::Index>(surface.number_of_vertices()), 3);
  for (int i = 0; i < result.rows(); ++i) {
    const Point& p = surface.point(vertex(i));
    result.row(i) << p.x(), p.y(), p.z();
  }
  return result;
}

}  // namespace swage::test
