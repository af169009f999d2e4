// As rigid as possible, by CGAL's Surface_mesh_deformation: the same formulation and the same handles.
#include <gtest/gtest.h>

#include <limits>

#include "cgal_arap.h"
#include "edit_measures.h"
#include "shapes.h"
#include "swage/deform.h"

namespace swage::test {
namespace {

Positions by_cgal(const Mesh& mesh, const Gesture& gesture, int passes) {
  CgalArap arap(mesh, gesture);
  arap.solve(passes);
  return arap.positions();
}

Positions by_swage(const Mesh& mesh, const Gesture& gesture, int passes) {
  DeformOptions options;
  options.pass_limit = passes;
  options.movement = std::numeric_limits<double>::min();
  options.acceleration_window = 0;
  return deform(mesh.positions, mesh.triangles, gesture, options).positions;
}

class ArapAndCgal : public testing::TestWithParam<NamedMesh> {};

TEST_P(ArapAndCgal, AgreePassByPass) {
  const Mesh& mesh = GetParam().mesh;
  Gesture gesture = move_top(mesh, {0.4, 0.3, -0.2});
  for (const int v : {3, 17}) {
    if (gesture.targets.count(v) == 0) gesture.add(v, mesh.positions.row(v).transpose() + Eigen::Vector3d(0, 0.2, 0.1));
  }
  for (const int passes : {1, 2, 10, 200}) {
    const Positions peer = by_cgal(mesh, gesture, passes);
    ASSERT_GT(deviation(mesh.positions, peer).largest, 0.01);
    EXPECT_LT(deviation(peer, by_swage(mesh, gesture, passes)).largest, 1e-6) << passes << " passes";
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, ArapAndCgal,
                         testing::Values(NamedMesh{"sphere", sphere(1, 3)}, NamedMesh{"box", box({1, 2, 0.5}, 6)},
                                         NamedMesh{"torus", torus(1, 0.4, 32, 16)}, NamedMesh{"sheet", sheet(10)},
                                         NamedMesh{"cylinder", cylinder(0.3, 1.5, 20, 12)}),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace swage::test
