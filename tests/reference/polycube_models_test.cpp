// PolyCubes of the shapes that the authors stylize.
#include <gtest/gtest.h>

#include <string>

#include "places.h"
#include "stylized.h"
#include "swage/mesh_io.h"
#include "swage/polycube.h"

namespace swage::test {
namespace {

class PolycubeModels : public testing::TestWithParam<const char*> {};

TEST_P(PolycubeModels, TurnNearlyAllOfTheirSurfaceAndKeepTheirTriangles) {
  if (!has_shared()) GTEST_SKIP() << "the models are not here";
  const MeshFile file = read_mesh(shared("oracle/stylize/inputs/" + std::string(GetParam()) + ".obj"));
  const Mesh& mesh = file.mesh;
  const Positions result = polycube(mesh.positions, mesh.triangles).positions;
  const Positions normals = cube_normals().normals;
  EXPECT_GT(share_near(mesh, result, normals, 5), 0.97);
  EXPECT_LT(mean_angle(mesh, result, normals), 1);
  EXPECT_EQ(turned_over(mesh, result), 0);
  EXPECT_NEAR(box_diagonal(result), box_diagonal(mesh.positions), 0.1 * box_diagonal(mesh.positions));
}

INSTANTIATE_TEST_SUITE_P(Authors, PolycubeModels, testing::Values("spot", "fandisk"),
                         [](const auto& instance) { return std::string(instance.param); });

}  // namespace
}  // namespace swage::test
