// Stylizing with weights that triangles of any shape leave sound, and in fewer passes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include "shapes.h"
#include "stylized.h"
#include "swage/error.h"
#include "swage/stylize.h"
#include "targets.h"

namespace swage::test {
namespace {

using enum StylizeEnergy;
using enum StylizeWeights;

const StylizeEnergy kEveryEnergy[] = {arap, farap, acap};

StylizeResult stylized(const Mesh& mesh, const ClosestNormals& style, double lambda, const StylizeOptions& options) {
  return stylize(mesh.positions, mesh.triangles, style, lambda, options);
}

std::vector<StylizeWeights> weights_for(StylizeEnergy energy) {
  if (energy == farap) return {cotangent, clamped};
  return {cotangent, clamped, intrinsic_delaunay};
}

/// A sphere about the y axis whose triangles are slanted the more, the higher.
Mesh twisted_sphere(double by) {
  Mesh mesh = sphere(1, 4);
  for (auto p : mesh.positions.rowwise()) {
    p = (Eigen::AngleAxisd(by * p[1], Eigen::Vector3d::UnitY()) * Eigen::Vector3d(p.transpose())).transpose();
  }
  return askew(mesh);
}

TEST(StylizeWeights, AreTheSameWhereNoCotangentsSumToLessThanNothing) {
  const Mesh mesh = askew(sphere(1, 2));
  for (const StylizeEnergy energy : kEveryEnergy) {
    StylizeOptions options;
    options.energy = energy;
    options.pass_limit = 20;
    const Positions plain = stylized(mesh, cube_normals(), 2, options).positions;
    for (const StylizeWeights weights : weights_for(energy)) {
      options.weights = weights;
      EXPECT_LT(far_apart(plain, stylized(mesh, cube_normals(), 2, options).positions), 1e-12)
          << to_string(energy) << ", " << to_string(weights);
    }
  }
}

TEST(StylizeWeights, NeverRaiseTheEnergyForConstantTargets) {
  const Mesh mesh = twisted_sphere(5);
  for (const StylizeEnergy energy : kEveryEnergy) {
    for (const StylizeWeights weights : weights_for(energy)) {
      StylizeOptions options;
      options.energy = energy;
      options.weights = weights;
      options.pass_limit = 60;
      const std::vector<double> energies = stylized(mesh, cube_normals(false), 3, options).report.energies;
      for (size_t i = 1; i < energies.size(); ++i) {
        EXPECT_LE(energies[i], energies[i - 1] * (1 + 1e-12)) << to_string(energy) << ", " << to_string(weights);
      }
    }
  }
}

TEST(StylizeWeights, MoveNothingWithoutWeightOfTheStyle) {
  const Mesh mesh = twisted_sphere(5);
  for (const StylizeWeights weights : {clamped, intrinsic_delaunay}) {
    StylizeOptions options;
    options.weights = weights;
    EXPECT_LT(far_apart(mesh.positions, stylized(mesh, cube_normals(), 0, options).positions), 1e-12);
  }
}

/// How far harmonic functions that are 1 at one vertex of a sheet's border and 0 at the others go below 0 inside.
double overshoot(const Mesh& mesh, StylizeWeights weights) {
  StylizeOptions options;
  options.weights = weights;
  const std::unique_ptr<StylizePlan> plan = plan_of(mesh, options);
  prepare(*plan, {});
  std::set<int> border;
  for (int e = 0; e < plan->edges.triangles.size(); ++e) {
    if (plan->edges.triangles[e].size() == 1) border.insert({plan->edges.vertices(e, 0), plan->edges.vertices(e, 1)});
  }
  HeldPoints points;
  points.fixed.assign(border.begin(), border.end());
  points.fixed_targets = Positions::Zero(static_cast<Eigen::Index>(border.size()), 3);
  const HeldLaplacian held(plan->system, points);
  double below = 0;
  for (Eigen::Index i = 0; i < points.fixed_targets.rows(); ++i) {
    points.fixed_targets.setZero();
    points.fixed_targets.row(i).setOnes();
    const Positions zero = Positions::Zero(mesh.positions.rows(), 3);
    below = std::max(below, -held.solve(zero, points).minCoeff());
  }
  return below;
}

TEST(StylizeWeights, HoldTheMaximumPrincipleThatPlainOnesBreak) {
  Mesh slanted = sheet(8);
  slanted.positions.col(0) += 3.3 * slanted.positions.col(1);
  EXPECT_GT(overshoot(slanted, cotangent), 0.01);
  EXPECT_LT(overshoot(slanted, clamped), 1e-9);
  EXPECT_LT(overshoot(slanted, intrinsic_delaunay), 1e-9);
}

TEST(StylizeWeights, OfIntrinsicTrianglesDependLessOnTheMeshs) {
  const auto cubic = [](const Mesh& mesh, StylizeWeights weights) {
    StylizeOptions options;
    options.weights = weights;
    return share_near(mesh, stylized(mesh, cube_normals(), 10, options).positions, cube_normals().normals, 10);
  };
  const Mesh good = twisted_sphere(0), slanted = twisted_sphere(3);
  const double due = cubic(good, cotangent);
  EXPECT_LT(due - cubic(slanted, intrinsic_delaunay), 0.6 * (due - cubic(slanted, cotangent)));
}

TEST(StylizeWeights, OfIntrinsicTrianglesAreNotForTheMeshsOwn) {
  const Mesh mesh = sphere(1, 1);
  StylizeOptions options;
  options.energy = farap;
  options.weights = intrinsic_delaunay;
  EXPECT_THROW(Stylize(mesh.positions, mesh.triangles, options), InvalidInput);
}

std::vector<NamedMesh> fine_shapes() {
  return {{"sphere", askew(sphere(1, 3))},
          {"torus", askew(torus(1, 0.4, 36, 18))},
          {"bumpy", askew(bumpy_sphere(0.05, 3))},
          {"sheet", askew(sheet(10))}};
}

class StylizeAcceleration : public testing::TestWithParam<NamedMesh> {
 protected:
  static StylizeResult stylized(StylizeEnergy energy, bool dynamic, int window, double movement = 1e-7) {
    StylizeOptions options;
    options.energy = energy;
    options.pass_limit = 20000;
    options.movement = movement;
    options.acceleration_window = window;
    return test::stylized(GetParam().mesh, cube_normals(dynamic), 1, options);
  }
};

TEST_P(StylizeAcceleration, ReachesTheSameFixedPointInAThirdOfThePasses) {
  for (const StylizeEnergy energy : kEveryEnergy) {
    const StylizeResult plain = stylized(energy, false, 0), fast = stylized(energy, false, 5);
    EXPECT_LT(far_apart(plain.positions, fast.positions), 1e-6) << to_string(energy);
    EXPECT_LE(3 * fast.report.passes, plain.report.passes + 3) << to_string(energy);
  }
}

/// Targets that are looked up again may settle otherwise.
TEST_P(StylizeAcceleration, ReachesAsLowAnEnergyForDynamicTargets) {
  for (const StylizeEnergy energy : kEveryEnergy) {
    const StylizeResult plain = stylized(energy, true, 0), fast = stylized(energy, true, 5);
    EXPECT_LT(fast.report.energy, 1.005 * plain.report.energy + 1e-12) << to_string(energy);
    EXPECT_LT(2 * fast.report.passes, plain.report.passes) << to_string(energy);
  }
}

TEST_P(StylizeAcceleration, NeverRaisesTheEnergyForConstantTargets) {
  for (const StylizeEnergy energy : kEveryEnergy) {
    const std::vector<double> energies = stylized(energy, false, 5).report.energies;
    for (size_t i = 1; i < energies.size(); ++i) EXPECT_LE(energies[i], energies[i - 1] * (1 + 1e-12));
  }
}

INSTANTIATE_TEST_SUITE_P(Any, StylizeAcceleration, testing::ValuesIn(fine_shapes()),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace swage::test
