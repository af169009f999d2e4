// ALUP, the forerunner of slippage-preserving reshaping (section 3).
#include <gtest/gtest.h>

#include <cmath>

#include "edit_measures.h"
#include "shapes.h"
#include "swage/compare.h"
#include "swage/reshape.h"

namespace swage::test {
namespace {

/// The lowest stay, the highest go by `by`.
Gesture lift(const Mesh& mesh, const Eigen::Vector3d& by) {
  Gesture gesture;
  const double low = mesh.positions.col(1).minCoeff(), high = mesh.positions.col(1).maxCoeff();
  for (int v = 0; v < mesh.positions.rows(); ++v) {
    if (mesh.positions(v, 1) <= low + 1e-9) gesture.add(v, mesh.positions.row(v).transpose());
    if (mesh.positions(v, 1) >= high - 1e-9) gesture.add(v, mesh.positions.row(v).transpose() + by);
  }
  return gesture;
}

Positions reshaped_by(const Mesh& mesh, const Gesture& gesture, ReshapeMethod method, ReshapeSolver solver) {
  ReshapeOptions options;
  options.method = method;
  options.solver = solver;
  return reshape(mesh.positions, mesh.triangles, gesture, options).positions;
}

class Alup : public testing::TestWithParam<ReshapeSolver> {};

/// Figure 5h: ALUP gives up orientation for uniform scale, and the slippage-preserving method does not.
TEST_P(Alup, ABoxMadeHigherKeepsItsNormalsLessThanSlippageDoes) {
  const Mesh mesh = box({1, 1, 1}, 6);
  const Gesture gesture = lift(mesh, {0, 0.6, 0});
  const auto change = [&](ReshapeMethod method) {
    return mean_normal_change(mesh, reshaped_by(mesh, gesture, method, GetParam()));
  };
  EXPECT_LT(change(ReshapeMethod::slippage), 0.5);
  EXPECT_GT(change(ReshapeMethod::alup), 1);
  EXPECT_LT(change(ReshapeMethod::alup), 5);
}

/// The vertices of a unit box that lie on so many of its faces or more, scaled.
Gesture scaled_end(const Mesh& mesh, int faces, const Eigen::Vector3d& scale) {
  Gesture gesture;
  for (int v = 0; v < mesh.positions.rows(); ++v) {
    const Eigen::Vector3d p = mesh.positions.row(v);
    if ((p.array() < 1e-9 || p.array() > 1 - 1e-9).count() >= faces) gesture.add(v, scale.cwiseProduct(p));
  }
  return gesture;
}

/// Whose edges are scaled along an axis, or whose corners in all directions.
TEST_P(Alup, AndSlippageKeepTheNormalsOfABoxThatIsScaled) {
  for (const int cells : {2, 6}) {
    const Mesh mesh = box({1, 1, 1}, cells);
    for (const ReshapeMethod method : {ReshapeMethod::slippage, ReshapeMethod::alup}) {
      const auto change = [&](const Gesture& gesture) {
        return mean_normal_change(mesh, reshaped_by(mesh, gesture, method, GetParam()));
      };
      for (const Eigen::Vector3d& scale : {Eigen::Vector3d(1, 1.6, 1), Eigen::Vector3d(0.6, 1, 1)}) {
        EXPECT_LT(change(scaled_end(mesh, 2, scale)), 0.1) << to_string(method);
      }
      EXPECT_LT(change(scaled_end(mesh, 3, {1.6, 1.6, 1.6})), 0.1) << to_string(method);
    }
  }
}

/// Two opposite vertices of a sphere, pulled apart by its radius.
TEST_P(Alup, ASphereGrowsAlike) {
  const Mesh mesh = sphere(1, 3);
  Gesture gesture;
  Eigen::Index low = 0, high = 0;
  mesh.positions.col(1).minCoeff(&low);
  mesh.positions.col(1).maxCoeff(&high);
  gesture.add(static_cast<int>(low), 1.5 * mesh.positions.row(low).transpose());
  gesture.add(static_cast<int>(high), 1.5 * mesh.positions.row(high).transpose());
  const Positions grown = reshaped_by(mesh, gesture, ReshapeMethod::alup, GetParam());
  const Comparison changes = compare(mesh.positions, grown, mesh.triangles);
  EXPECT_LT(changes.uneven.mean, 0.05);
  EXPECT_GT(changes.size.mean, std::log(1.3));
}

INSTANTIATE_TEST_SUITE_P(Both, Alup, testing::Values(ReshapeSolver::steady, ReshapeSolver::published),
                         [](const auto& tested) { return std::string(to_string(tested.param)); });

/// Conformality is what the slippage-preserving method gives up (figure 5e).
TEST(AlupAndSlippage, ACylinderMadeLongerGrowsWiderInTheFormer) {
  const Mesh mesh = cylinder(0.5, 1, 32, 10);
  Gesture gesture;
  Eigen::Index low = 0, high = 0;
  (mesh.positions.rowwise() - Eigen::RowVector3d(0, mesh.positions.col(1).minCoeff(), 0))
      .rowwise()
      .norm()
      .minCoeff(&low);
  (mesh.positions.rowwise() - Eigen::RowVector3d(0, mesh.positions.col(1).maxCoeff(), 0))
      .rowwise()
      .norm()
      .minCoeff(&high);
  gesture.add(static_cast<int>(low), mesh.positions.row(low).transpose());
  gesture.add(static_cast<int>(high), mesh.positions.row(high).transpose() + Eigen::Vector3d(0, 1, 0));
  const auto width = [&](ReshapeMethod method) {
    const Positions longer = reshaped_by(mesh, gesture, method, ReshapeSolver::steady);
    return longer.col(0).maxCoeff() - longer.col(0).minCoeff();
  };
  EXPECT_GT(width(ReshapeMethod::alup), 1.2 * width(ReshapeMethod::slippage));
}

}  // namespace
}  // namespace swage::test
