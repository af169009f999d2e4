// The steady solver on models that the authors have no results of: whatever the resolution and the stop.
#include <gtest/gtest.h>

#include <string>

#include "edit_measures.h"
#include "places.h"
#include "shapes.h"
#include "swage/mesh_io.h"
#include "swage/reshape.h"

namespace swage {
namespace {

/// Along the longest side of the box: by a fifth of D, the lowest fiftieth pinned and the topmost tenth moved, or a
/// vertex of each.
Gesture stretch(const Mesh& mesh, bool of_two_vertices) {
  const Eigen::RowVector3d low = mesh.positions.colwise().minCoeff(), high = mesh.positions.colwise().maxCoeff();
  Eigen::Index axis = 0, bottom = 0, top = 0;
  (high - low).maxCoeff(&axis);
  const Eigen::VectorXd height = (mesh.positions.col(axis).array() - low[axis]) / (high[axis] - low[axis]);
  height.minCoeff(&bottom);
  height.maxCoeff(&top);
  const Eigen::RowVector3d by = 0.2 * (high - low).norm() * Eigen::RowVector3d::Unit(axis);
  Gesture gesture;
  for (int v = 0; v < mesh.positions.rows(); ++v) {
    if (of_two_vertices ? v == bottom : height[v] < 0.02) gesture.add(v, mesh.positions.row(v));
    if (of_two_vertices ? v == top : height[v] > 0.9) gesture.add(v, mesh.positions.row(v) + by);
  }
  return gesture;
}

class SteadyModel : public testing::TestWithParam<std::string> {};

TEST_P(SteadyModel, DependsLittleOnTheResolutionAndTheStop) {
  if (!test::has_shared()) GTEST_SKIP() << "the real meshes are not here";
  const Mesh mesh = read_mesh(test::shared("data/meshes/A_closed_manifold") / GetParam()).mesh;
  const Mesh fine = test::subdivided(mesh);
  Reshape coarse(mesh.positions, mesh.triangles), refined(fine.positions, fine.triangles);
  ReshapeOptions options;
  options.movement /= 10;
  Reshape tight(mesh.positions, mesh.triangles, options);
  for (const bool of_two_vertices : {false, true}) {
    const Gesture gesture = stretch(mesh, of_two_vertices);
    const ReshapeResult result = coarse.solve(gesture);
    EXPECT_EQ(result.report.stop, Termination::moved_little);
    const test::Deviation deviation = test::deviation(result.positions, refined.solve(gesture).positions);
    EXPECT_LT(deviation.mean, 0.005) << of_two_vertices;
    EXPECT_LT(deviation.largest, 0.015) << of_two_vertices;
    EXPECT_LT(test::deviation(result.positions, tight.solve(gesture).positions).largest, 1e-3) << of_two_vertices;
  }
}

// The joint pulled at two vertices and spot change the most of twenty models.
INSTANTIATE_TEST_SUITE_P(Unseen, SteadyModel,
                         testing::Values("joint_remeshed.off", "spot_low_resolution.obj", "busted.STL",
                                         "bullet_duck.obj", "tripod_remeshed.off", "Havocglass8_left_remeshed.off"),
                         [](const auto& named) { return named.param.substr(0, named.param.find('.')); });

}  // namespace
}  // namespace swage
