// The normal_fit step: what its result must be, by every backend.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <memory>
#include <string>

#include "adjacency.h"
#include "element_pairs.h"
#include "measures.h"
#include "opencl_device.h"
#include "shapes.h"

namespace swage {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;

struct Who {
  const char* name;
  std::shared_ptr<Backend> (*backend)();
  double tolerance;
};

const Who kWho[] = {
    {"cpu", [] { return cpu_backend(); }, 1e-13},
    {"opencl_single", [] { return test::opencl_or_skip(Precision::single); }, 3e-6},
    {"opencl_double", [] { return test::opencl_or_skip(Precision::twice); }, 1e-13},
};

struct Fitted {
  Transforms directions;
  Positions spreads;
};

class NormalFitStepBy : public testing::TestWithParam<Who> {
 protected:
  void SetUp() override { backend_ = GetParam().backend(); }

  Fitted fit(const Mesh& mesh) const {
    Fitted fitted;
    backend_->normal_fit(test::triangles_around(mesh))
        ->fit(area_vectors(mesh.positions, mesh.triangles), fitted.directions, fitted.spreads);
    return fitted;
  }

  /// Directions at right angles, ascending spreads, and together the moment, which is summed here from areas.
  void expect_principal(const Mesh& mesh, const Fitted& fitted) const {
    const Lists around = triangles_of_vertices(mesh.triangles, static_cast<int>(mesh.positions.rows()));
    const Positions normals = unit_normals(mesh.positions, mesh.triangles);
    const Eigen::VectorXd areas = area_vectors(mesh.positions, mesh.triangles).rowwise().norm() / 2;
    const double tolerance = GetParam().tolerance;
    ASSERT_EQ(fitted.directions.rows(), mesh.positions.rows());
    for (int v = 0; v < static_cast<int>(mesh.positions.rows()); ++v) {
      Matrix3d moment = Matrix3d::Zero();
      for (const int t : around[v]) moment += areas[t] * normals.row(t).transpose() * normals.row(t);
      const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> rows(fitted.directions.row(v).data());
      const Eigen::RowVector3d spreads = fitted.spreads.row(v);
      ASSERT_LT((rows * rows.transpose() - Matrix3d::Identity()).norm(), 3 * tolerance) << "vertex " << v;
      ASSERT_LE(spreads[0], spreads[1]) << "vertex " << v;
      ASSERT_LE(spreads[1], spreads[2]) << "vertex " << v;
      ASSERT_LE((rows.transpose() * spreads.asDiagonal() * rows - moment).norm(), 3 * tolerance * moment.trace())
          << "vertex " << v;
    }
  }

  std::shared_ptr<Backend> backend_;
};

TEST_P(NormalFitStepBy, GivesTheMomentBack) {
  if (!backend_) return;
  for (const Mesh& mesh : {test::sphere(1, 3), test::torus(), test::box({1, 2, 0.5}, 4), test::sheet(6)}) {
    for (const double size : {1e-4, 1.0, 1e4}) {
      Mesh askew = test::transformed(mesh, size, {0, 0, 0});
      askew.positions *= Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 0.4, 0.3).normalized()).toRotationMatrix();
      expect_principal(askew, fit(askew));
    }
  }
}

TEST_P(NormalFitStepBy, KnowsFlatEdgesAndCorners) {
  if (!backend_) return;
  const Mesh box = test::box({1, 1, 1}, 4);
  const Fitted fitted = fit(box);
  const double square = 1.0 / 16;
  for (Index v = 0; v < box.positions.rows(); ++v) {
    // Of the triangles around, how many directions they face: the sides of the box that the vertex lies on.
    int sides = 0;
    for (int k = 0; k < 3; ++k) sides += std::abs(std::abs(box.positions(v, k) - 0.5) - 0.5) < 1e-12 ? 1 : 0;
    const int spread = static_cast<int>((fitted.spreads.row(v).array() > 0.1 * square).count());
    ASSERT_EQ(spread, sides) << "vertex " << v << " at " << box.positions.row(v);
  }
}

TEST_P(NormalFitStepBy, LeavesWhatHasNoTrianglesOrNoArea) {
  if (!backend_) return;
  Mesh mesh = test::sheet(3);
  mesh.positions.conservativeResize(mesh.positions.rows() + 2, 3);
  mesh.positions.bottomRows(2).setConstant(5);
  mesh.triangles.conservativeResize(mesh.triangles.rows() + 1, 3);
  mesh.triangles.bottomRows(1).setConstant(static_cast<int>(mesh.positions.rows()) - 1);
  const Fitted fitted = fit(mesh);
  EXPECT_EQ(fitted.spreads.bottomRows(2), Positions(Positions::Zero(2, 3)));
  expect_principal(mesh, fitted);
}

TEST_P(NormalFitStepBy, GivesTheSameBytesAgainAndRefusesOtherRows) {
  if (!backend_) return;
  const Mesh mesh = test::torus();
  const auto step = backend_->normal_fit(test::triangles_around(mesh));
  const Positions areas = area_vectors(mesh.positions, mesh.triangles);
  Fitted first, again;
  step->fit(areas, first.directions, first.spreads);
  step->fit(areas.array().sin().matrix(), again.directions, again.spreads);
  step->fit(areas, again.directions, again.spreads);
  EXPECT_EQ(first.directions, again.directions);
  EXPECT_EQ(first.spreads, again.spreads);
  EXPECT_THROW(step->fit(areas.topRows(5), again.directions, again.spreads), InvalidInput);
}

INSTANTIATE_TEST_SUITE_P(Backends, NormalFitStepBy, testing::ValuesIn(kWho),
                         [](const auto& of) { return std::string(of.param.name); });

}  // namespace
}  // namespace swage
