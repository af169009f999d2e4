// Reshaping with all local steps on a device.
#include <gtest/gtest.h>

#include "opencl_device.h"
#include "shapes.h"
#include "swage/reshape.h"

namespace swage {
namespace {

std::vector<test::NamedMesh> meshes_to_reshape() {
  return {{"cylinder", test::cylinder(0.5, 1, 24, 8)},
          {"box", test::box({1, 2, 1}, 5)},
          {"torus", test::torus(1, 0.4, 24, 12)},
          {"sphere", test::sphere(1, 3)},
          {"tiny", test::transformed(test::box({1, 2, 1}, 5), 1e-4, {0, 0, 0})},
          {"huge, far away", test::transformed(test::box({1, 2, 1}, 5), 1e4, {3e4, 0, 0})}};
}

/// The lowest vertex held, the highest lifted by a quarter of the diagonal, somewhat aslant.
Gesture lift_highest(const Mesh& mesh) {
  Eigen::Index low = 0, high = 0;
  mesh.positions.col(1).minCoeff(&low);
  mesh.positions.col(1).maxCoeff(&high);
  const double quarter = box_diagonal(mesh.positions) / 4;
  Gesture gesture;
  gesture.add(static_cast<int>(low), mesh.positions.row(low));
  gesture.add(static_cast<int>(high), mesh.positions.row(high).transpose() + Eigen::Vector3d(0.2, 1, 0) * quarter);
  return gesture;
}

ReshapeResult reshaped_on(const Mesh& mesh, std::shared_ptr<Backend> backend,
                          ReshapeSolver solver = ReshapeSolver::steady) {
  ReshapeOptions options;
  options.solver = solver;
  options.backend = std::move(backend);
  return reshape(mesh.positions, mesh.triangles, lift_highest(mesh), options);
}

void expect_the_references(const std::shared_ptr<Backend>& backend, ReshapeSolver solver, double tolerance) {
  for (const auto& [name, mesh] : meshes_to_reshape()) {
    SCOPED_TRACE(name);
    const ReshapeResult expected = reshaped_on(mesh, cpu_backend(), solver),
                        result = reshaped_on(mesh, backend, solver);
    EXPECT_EQ(result.report.stop, expected.report.stop);
    EXPECT_EQ(result.report.passes, expected.report.passes);
    EXPECT_EQ(result.finalised, expected.finalised);
    const double moved = (expected.positions - mesh.positions).rowwise().norm().maxCoeff();
    EXPECT_GT(moved, 0.1 * box_diagonal(mesh.positions));
    EXPECT_LT((result.positions - expected.positions).rowwise().norm().maxCoeff() / box_diagonal(mesh.positions),
              tolerance);
  }
}

TEST(ReshapeOnADevice, IsTheReferenceInDouble) {
  const auto backend = test::opencl_or_skip(Precision::twice);
  if (!backend) return;
  expect_the_references(backend, ReshapeSolver::published, 1e-9);
  // Its passes stop near their minima, and rounding decides where.
  expect_the_references(backend, ReshapeSolver::steady, 1e-8);
}

TEST(ReshapeOnADevice, IsTheReferenceInSingle) {
  const auto backend = test::opencl_or_skip(Precision::single);
  if (!backend) return;
  expect_the_references(backend, ReshapeSolver::published, 2e-5);
  expect_the_references(backend, ReshapeSolver::steady, 2e-5);
}

TEST(ReshapeOnADevice, GivesTheSameBytesFromRunToRun) {
  const auto backend = test::opencl_or_skip(Precision::single);
  if (!backend) return;
  const Mesh mesh = test::cylinder(0.5, 1, 24, 8);
  EXPECT_EQ(reshaped_on(mesh, backend).positions, reshaped_on(mesh, backend).positions);
}

TEST(ReshapeOnADevice, AFlatteningGestureStaysFinite) {
  const Mesh mesh = test::box({1, 1, 1}, 4);
  Gesture flat;
  for (int v = 0; v < mesh.positions.rows(); ++v) flat.add(v, {mesh.positions(v, 0), 0, mesh.positions(v, 2)});
  for (const Precision precision : {Precision::twice, Precision::single}) {
    ReshapeOptions options;
    options.backend = test::opencl_or_skip(precision);
    if (!options.backend) return;
    const ReshapeResult result = reshape(mesh.positions, mesh.triangles, flat, options);
    EXPECT_TRUE(result.positions.allFinite());
    EXPECT_LT(result.positions.col(1).cwiseAbs().maxCoeff(), 1e-2);
  }
}

}  // namespace
}  // namespace swage
