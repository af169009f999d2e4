// The promises of resizing, on every real mesh.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ball_amid_slabs.h"
#include "grid_folds.h"
#include "mesh_index.h"
#include "places.h"
#include "swage/mesh_io.h"

namespace swage::test {
namespace {

using Factors = Eigen::RowVector3d;

const std::vector<ListedMesh>& meshes() {
  static const std::vector<ListedMesh> all = listed_meshes();
  return all;
}

void expect_promises(Resize& plan, const Mesh& mesh, const Factors& factors) {
  SCOPED_TRACE(testing::Message() << "factors " << factors);
  const double D = box_diagonal(mesh.positions);
  ResizeTarget target;
  target.factors = factors;
  const ResizeResult result = plan.solve(target);
  ASSERT_EQ(result.positions.rows(), mesh.positions.rows());
  ASSERT_TRUE(result.positions.allFinite());
  for (int u = 0; u < 3; ++u) {
    const double factor = plan.shape().extends(u) ? factors[u] : 1;
    EXPECT_NEAR(extents(result.positions)[u], factor * extents(mesh.positions)[u], 1e-6 * D);
  }
  EXPECT_GT(least_determinant(plan.shape(), result.grid), 0);
  EXPECT_GT(result.least_scale, 0);
  EXPECT_GT(result.least_edge, 0);
  // At the strongest factors solves may end before their tolerance. Then they say so.
  if (result.report.stop != Termination::energy_settled) {
    EXPECT_THAT(result.report.warnings, testing::Contains(testing::HasSubstr("did not reach the tolerance")));
  }
}

/// So that they run side by side.
constexpr int kShares = 10;

class ResizeMeshes : public testing::TestWithParam<int> {};

TEST_P(ResizeMeshes, MeetTheirBoxAndTurnNothingOver) {
  if (!has_shared()) GTEST_SKIP() << "no real meshes beside this checkout";
  int seen = 0;
  for (size_t m = static_cast<size_t>(GetParam()); m < meshes().size(); m += kShares) {
    SCOPED_TRACE(meshes()[m].name);
    const Mesh mesh = read_mesh(meshes()[m].path).mesh;
    Resize plan(mesh.positions, mesh.triangles);
    for (const Factors& factors : {Factors(2, 1, 1), Factors(1, 0.5, 1), Factors(0.3, 1, 3)}) {
      expect_promises(plan, mesh, factors);
    }
    ResizeTarget nothing;
    EXPECT_LT((plan.solve(nothing).positions - mesh.positions).cwiseAbs().maxCoeff(),
              1e-9 * box_diagonal(mesh.positions));
    ++seen;
  }
  EXPECT_GT(seen, 10);
}

/// One of each kind: closed, open, of parts, not manifold, badly shaped, flat.
constexpr std::array<const char*, 10> kTen = {
    "A_closed_manifold/phone.obj",
    "A_closed_manifold/e_car_extruded.obj",
    "A_closed_manifold/fandisk_quads.off",
    "B_open_manifold/gc_lego.ply",
    "B_open_manifold/holes.off",
    "C_multi_component/fox_kitcar.obj",
    "C_multi_component/bones.off",
    "D_non_manifold/homedecor_table_lamp.obj",
    "D_non_manifold/homedecor_office_chair_upscale.obj",
    "E_bad_shape/diff_carrier.stl",
};

TEST_P(ResizeMeshes, TurnNothingOverAtAnyFactor) {
  if (!has_shared()) GTEST_SKIP() << "no real meshes beside this checkout";
  const std::string name = kTen.at(static_cast<size_t>(GetParam()));
  SCOPED_TRACE(name);
  const Mesh mesh = read_mesh(shared("data/meshes") / name).mesh;
  Resize plan(mesh.positions, mesh.triangles);
  for (int u = 0; u < 3; ++u) {
    for (const double factor : {0.05, 20.0}) {
      Factors factors(1, 1, 1);
      factors[u] = factor;
      expect_promises(plan, mesh, factors);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Share, ResizeMeshes, testing::Range(0, kShares));

}  // namespace
}  // namespace swage::test
