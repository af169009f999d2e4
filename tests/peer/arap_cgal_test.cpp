// As rigid as possible, by CGAL's Surface_mesh_deformation: the same formulation (spokes and rims, cotangent weights)
// and the same handles. Its licence is the GPL: this program alone has it.
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_deformation.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "edit_measures.h"
#include "shapes.h"
#include "swage/deform.h"

namespace swage::test {
namespace {

using Point = CGAL::Simple_cartesian<double>::Point_3;
using Surface = CGAL::Surface_mesh<Point>;
using SpokesAndRims = CGAL::Surface_mesh_deformation<Surface, CGAL::Default, CGAL::Default, CGAL::SPOKES_AND_RIMS>;

CGAL::SM_Vertex_index vertex(int i) { return CGAL::SM_Vertex_index(static_cast<CGAL::SM_Vertex_index::size_type>(i)); }

Positions by_cgal(const Mesh& mesh, const Gesture& gesture, unsigned passes) {
  Surface surface;
  for (const auto& p : mesh.positions.rowwise()) surface.add_vertex(Point(p[0], p[1], p[2]));
  for (const auto& t : mesh.triangles.rowwise()) surface.add_face(vertex(t[0]), vertex(t[1]), vertex(t[2]));
  SpokesAndRims deformation(surface);
  deformation.insert_roi_vertices(surface.vertices().begin(), surface.vertices().end());
  for (const auto& [i, target] : gesture.targets) deformation.insert_control_vertex(vertex(i));
  EXPECT_TRUE(deformation.preprocess());
  for (const auto& [i, target] : gesture.targets) {
    deformation.set_target_position(vertex(i), Point(target[0], target[1], target[2]));
  }
  deformation.deform(passes, 0);
  Positions result(mesh.positions.rows(), 3);
  for (int i = 0; i < result.rows(); ++i) {
    const Point& p = surface.point(vertex(i));
    result.row(i) << p.x(), p.y(), p.z();
  }
  return result;
}

Positions by_swage(const Mesh& mesh, const Gesture& gesture, int passes) {
  DeformOptions options;
  options.pass_limit = passes;
  options.movement = std::numeric_limits<double>::min();
  options.acceleration_window = 0;
  return deform(mesh.positions, mesh.triangles, gesture, options).positions;
}

struct Case {
  std::string name;
  Mesh mesh;
};

class ArapAndCgal : public testing::TestWithParam<Case> {};

TEST_P(ArapAndCgal, AgreePassByPass) {
  const Mesh& mesh = GetParam().mesh;
  Gesture gesture = move_top(mesh, {0.4, 0.3, -0.2});
  for (const int v : {3, 17}) {
    if (gesture.targets.count(v) == 0) gesture.add(v, mesh.positions.row(v).transpose() + Eigen::Vector3d(0, 0.2, 0.1));
  }
  for (const int passes : {1, 2, 10, 200}) {
    const Positions peer = by_cgal(mesh, gesture, static_cast<unsigned>(passes));
    ASSERT_GT(deviation(mesh.positions, peer).largest, 0.01);
    EXPECT_LT(deviation(peer, by_swage(mesh, gesture, passes)).largest, 1e-6) << passes << " passes";
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, ArapAndCgal,
                         testing::Values(Case{"sphere", sphere(1, 3)}, Case{"box", box({1, 2, 0.5}, 6)},
                                         Case{"torus", torus(1, 0.4, 32, 16)}, Case{"sheet", sheet(10)},
                                         Case{"cylinder", cylinder(0.3, 1.5, 20, 12)}),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace swage::test
