// Stylizing: what the method promises, on generated shapes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <omp.h>

#include <Eigen/Geometry>
#include <cmath>

#include "adjacency.h"
#include "measures.h"
#include "opencl_device.h"
#include "refused.h"
#include "shapes.h"
#include "stylized.h"
#include "swage/error.h"
#include "swage/stylize.h"

namespace swage::test {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::HasSubstr;
using enum StylizeEnergy;

const StylizeEnergy kEnergies[] = {arap, farap, acap};

StylizeOptions by(StylizeEnergy energy, int pass_limit = 350) {
  StylizeOptions options;
  options.energy = energy;
  options.pass_limit = pass_limit;
  return options;
}

std::vector<NamedMesh> meshes_to_stylize() {
  return {{"sphere", askew(sphere(1, 2))},
          {"torus", askew(torus(1, 0.4, 24, 12))},
          {"box", askew(box({1, 2, 0.5}, 4))},
          {"sheet", askew(sheet(6))},
          {"apart", askew(joined(sphere(1, 2), transformed(sphere(1, 2), 0.5, {3, 0, 0})))}};
}

class StylizeShape : public testing::TestWithParam<NamedMesh> {};

TEST_P(StylizeShape, StaysAsItIsWithoutWeight) {
  const Mesh& mesh = GetParam().mesh;
  for (const StylizeEnergy energy : kEnergies) {
    const StylizeResult result = stylize(mesh.positions, mesh.triangles, cube_normals(), 0, by(energy));
    EXPECT_LT(far_apart(mesh.positions, result.positions), 1e-12) << to_string(energy);
    EXPECT_EQ(result.report.stop, Termination::moved_little) << to_string(energy);
  }
}

TEST_P(StylizeShape, GoesWithMotionsOfItselfAndItsStyle) {
  const Mesh& mesh = GetParam().mesh;
  Mesh moved = mesh;
  moved.positions = (2.5 * mesh.positions * kTurn.transpose()).rowwise() + Eigen::RowVector3d(0.7, -1.2, 0.4);
  ClosestNormals style = cube_normals(), turned = style;
  turned.normals = style.normals * kTurn.transpose();
  for (const StylizeEnergy energy : kEnergies) {
    const Positions here = stylize(mesh.positions, mesh.triangles, style, 1, by(energy, 5)).positions;
    const Positions there = stylize(moved.positions, moved.triangles, turned, 1, by(energy, 5)).positions;
    const Positions expected = (2.5 * here * kTurn.transpose()).rowwise() + Eigen::RowVector3d(0.7, -1.2, 0.4);
    EXPECT_LT(far_apart(expected, there), 1e-9) << to_string(energy);
  }
}

TEST_P(StylizeShape, NeverRaisesTheEnergyForConstantTargets) {
  const Mesh& mesh = GetParam().mesh;
  for (const StylizeEnergy energy : kEnergies) {
    for (const double lambda : {0.1, 10.0}) {
      const StylizeResult result = stylize(mesh.positions, mesh.triangles, cube_normals(false), lambda, by(energy, 60));
      const std::vector<double>& energies = result.report.energies;
      for (size_t i = 1; i < energies.size(); ++i) {
        EXPECT_LE(energies[i], energies[i - 1] * (1 + 1e-12)) << to_string(energy) << ", pass " << i;
      }
    }
  }
}

TEST_P(StylizeShape, TurnsAsItsGivenNormalsDo) {
  const Mesh& mesh = GetParam().mesh;
  for (const StylizeEnergy energy : kEnergies) {
    const GivenNormals turned{unit_normals(mesh.positions, mesh.triangles) * kTurn.transpose(), true};
    StylizeOptions options = by(energy, 1000);
    options.movement = 1e-6;
    const Positions result = stylize(mesh.positions, mesh.triangles, turned, 1, options).positions;
    const Positions normals = unit_normals(result, mesh.triangles);
    EXPECT_LT((normals - turned.normals).rowwise().norm().maxCoeff(), 1e-3) << to_string(energy);
  }
}

TEST_P(StylizeShape, NearsItsTargets) {
  const Mesh& mesh = GetParam().mesh;
  const Positions normals = cube_normals().normals;
  const double before = mean_angle(mesh, mesh.positions, normals);
  for (const StylizeEnergy energy : kEnergies) {
    const StylizeResult result = stylize(mesh.positions, mesh.triangles, cube_normals(), 10, by(energy, 60));
    EXPECT_LT(mean_angle(mesh, result.positions, normals), 0.7 * before) << to_string(energy);
  }
}

INSTANTIATE_TEST_SUITE_P(Any, StylizeShape, testing::ValuesIn(meshes_to_stylize()),
                         [](const auto& instance) { return instance.param.name; });

/// What is left out is the triangles along the cube's edges: the finer the mesh, the fewer.
TEST(Stylize, MakesASphereACube) {
  const auto share = [](const Mesh& mesh, StylizeEnergy energy) {
    const Positions cubic = stylize(mesh.positions, mesh.triangles, cube_normals(), 10, by(energy)).positions;
    return share_near(mesh, cubic, cube_normals().normals, 10);
  };
  for (const bool turned : {false, true}) {
    const auto of = [&](int subdivisions) { return turned ? askew(sphere(1, subdivisions)) : sphere(1, subdivisions); };
    EXPECT_GE(share(of(3), arap), 0.79);
    EXPECT_GE(share(of(4), arap), 0.89);
    EXPECT_GE(share(of(5), arap), 0.935);
    EXPECT_GE(share(of(3), farap), 0.9);
    EXPECT_GE(share(of(4), farap), 0.94);
    EXPECT_GE(share(of(5), farap), 0.965);
  }
}

TEST(Stylize, KeepsItsSizeWhereItScalesFreely) {
  const Mesh mesh = joined(askew(sphere(1, 3)), transformed(askew(torus(1, 0.4, 24, 12)), 0.5, {3, 0, 0}));
  const auto extents = [&](const Positions& positions, Eigen::Index first, Eigen::Index count) {
    const auto part = positions.middleRows(first, count);
    return (part.colwise().maxCoeff() - part.colwise().minCoeff()).eval();
  };
  const Eigen::Index half = sphere(1, 3).positions.rows(), rest = mesh.positions.rows() - half;
  Gesture pin;  // In one place: it gives no size.
  pin.add(0, mesh.positions.row(0).transpose());
  for (const Gesture& handles : {Gesture(), pin}) {
    const Positions result =
        stylize(mesh.positions, mesh.triangles, cube_normals(), 10, by(acap, 1000), handles).positions;
    EXPECT_NEAR(extents(result, 0, half).mean(), 0.78 * extents(mesh.positions, 0, half).mean(), 0.08);
    EXPECT_GT(extents(result, half, rest).mean(), 0.7 * extents(mesh.positions, half, rest).mean());
  }
  Gesture smaller;
  for (int v = 0; v < half; v += 20) smaller.add(v, mesh.positions.row(v).transpose() / 2);
  const Positions result =
      stylize(mesh.positions, mesh.triangles, cube_normals(), 0.01, by(acap, 1000), smaller).positions;
  EXPECT_NEAR(extents(result, 0, half).mean(), extents(mesh.positions, 0, half).mean() / 2, 0.02);
}

TEST(Stylize, MeetsItsHandlesAndHoldsEachOtherComponentByAVertex) {
  const Mesh mesh = joined(sphere(1, 2), transformed(sphere(1, 2), 0.5, {3, 0, 0}));
  const auto half = static_cast<int>(mesh.positions.rows() / 2);
  Gesture handles;
  handles.add(3, {1, 1, 1});
  handles.add(20, {-1, 0, 0.5});
  const StylizeResult result = stylize(mesh.positions, mesh.triangles, cube_normals(), 1, by(arap), handles);
  for (const auto& [vertex, target] : handles.targets) {
    EXPECT_LT((result.positions.row(vertex).transpose() - target).norm(), 1e-12);
  }
  const auto still = (result.positions - mesh.positions).bottomRows(half).rowwise().norm();
  EXPECT_LT(still.minCoeff(), 1e-12);
  EXPECT_LT(still.maxCoeff(), 0.5);
  EXPECT_THAT(result.report.warnings, testing::Contains(HasSubstr("2 components")));
}

TEST(Stylize, TakesAnyListOfTriangles) {
  Mesh mesh = joined(sheet(4), sphere(0.3, 1));
  const Eigen::Index triangles = mesh.triangles.rows(), vertices = mesh.positions.rows();
  mesh.triangles.conservativeResize(triangles + 2, 3);
  mesh.triangles.row(triangles) = mesh.triangles.row(3);
  mesh.triangles.row(triangles + 1) << 0, 1, 0;
  mesh.positions.conservativeResize(vertices + 1, 3);
  mesh.positions.row(vertices) << 0.3, 0.4, 2;
  for (const StylizeEnergy energy : kEnergies) {
    for (const Style& style :
         {Style(cube_normals()), Style(Developable{}), Style(GivenNormals{Positions::Ones(vertices + 1, 3)})}) {
      const StylizeResult result = stylize(mesh.positions, mesh.triangles, style, 1, by(energy, 20));
      EXPECT_EQ(result.positions.rows(), mesh.positions.rows());
      EXPECT_TRUE(result.positions.allFinite());
    }
  }
}

TEST(Stylize, SolvesAgainAsTheFirstTime) {
  const Mesh mesh = askew(torus(1, 0.4, 24, 12));
  Stylize method(mesh.positions, mesh.triangles, by(acap, 10));
  ASSERT_TRUE(method.prepare());
  Gesture handles;
  handles.add(7, mesh.positions.row(7).transpose() * 1.2);
  method.solve(Developable{}, 1000);
  method.solve(cube_normals(), 3, handles);
  const Positions again = method.solve(cube_normals(), 2).positions;
  EXPECT_EQ(again, stylize(mesh.positions, mesh.triangles, cube_normals(), 2, by(acap, 10)).positions);
}

TEST(Stylize, TellsBothPartsOfTheEnergy) {
  const Mesh mesh = askew(sphere(1, 2));
  const StylizeResult result = stylize(mesh.positions, mesh.triangles, cube_normals(), 3, by(arap, 7));
  ASSERT_EQ(result.passes.size(), 7u);
  ASSERT_EQ(result.report.energies.size(), 7u);
  for (size_t i = 0; i < 7; ++i) {
    EXPECT_NEAR(result.report.energies[i], result.passes[i].shape + 3 * result.passes[i].normals, 1e-12);
  }
}

TEST(Stylize, StopsWhereItsCallerCancels) {
  const Mesh mesh = askew(sphere(1, 2));
  for (const int last : {0, 1, 3, 6}) {
    int asked = 0;
    const auto cancel = [&](const Progress&) { return asked++ < last; };
    const StylizeResult result = stylize(mesh.positions, mesh.triangles, cube_normals(), 1, {}, {}, cancel);
    EXPECT_EQ(result.report.stop, Termination::cancelled);
    EXPECT_EQ(result.positions.rows(), mesh.positions.rows());
    if (result.report.passes == 0) {
      EXPECT_EQ(result.positions, mesh.positions);
    }
  }
}

TEST(Stylize, IsTheSameBytesOnOneThreadAndTwo) {
  const Mesh mesh = askew(torus(1, 0.4, 200, 100));
  const int threads = omp_get_max_threads();
  for (const StylizeEnergy energy : kEnergies) {
    omp_set_num_threads(1);
    const Positions one = stylize(mesh.positions, mesh.triangles, cube_normals(), 1, by(energy, 3)).positions;
    omp_set_num_threads(2);
    EXPECT_EQ(one, stylize(mesh.positions, mesh.triangles, cube_normals(), 1, by(energy, 3)).positions);
  }
  omp_set_num_threads(threads);
}

TEST(Stylize, HasTheSizeThatHandlesGiveWhereScalesAreFree) {
  const Mesh mesh = askew(torus(1, 0.4, 24, 12));
  Gesture handles;
  for (const int v : {0, 7 * 12, 15 * 12}) handles.add(v, 2 * mesh.positions.row(v).transpose());
  StylizeOptions options = by(acap, 1000);
  options.movement = 1e-9;
  const StylizeResult result = stylize(mesh.positions, mesh.triangles, cube_normals(), 0, options, handles);
  EXPECT_LT(far_apart(2 * mesh.positions, result.positions), 1e-3);
}

void expect_as_on_cpu(Precision precision, double tolerance) {
  const std::shared_ptr<Backend> device = opencl_or_skip(precision);
  if (!device) return;
  for (const double size : {1e-2, 1.0, 1e2}) {
    const Mesh mesh = transformed(askew(torus(1, 0.4, 24, 12)), size, {0, 0, 0});
    for (const StylizeEnergy energy : kEnergies) {
      StylizeOptions options = by(energy, 1000);
      options.movement = 1e-5;  // Else one may stop a pass before the other.
      for (const bool dynamic : {false, true}) {
        options.backend = cpu_backend();
        const ClosestNormals style = cube_normals(dynamic);
        const Positions host = stylize(mesh.positions, mesh.triangles, style, 1, options).positions;
        options.backend = device;
        const Positions there = stylize(mesh.positions, mesh.triangles, style, 1, options).positions;
        EXPECT_LT(far_apart(host, there), tolerance) << to_string(energy) << " at " << size << ", dynamic " << dynamic;
      }
    }
  }
}

TEST(Stylize, IsTheSameOnADeviceInSingle) { expect_as_on_cpu(Precision::single, 1e-4); }
TEST(Stylize, IsTheSameOnADeviceInDouble) { expect_as_on_cpu(Precision::twice, 1e-8); }

TEST(Stylize, RefusesWhatItCannotTake) {
  const Mesh mesh = sphere(1, 1);
  const double nan = std::nan("");
  const auto solve = [&](const Style& style, double lambda) {
    return [&mesh, style, lambda] { stylize(mesh.positions, mesh.triangles, style, lambda); };
  };
  const auto with = [&](const StylizeOptions& options) {
    return [&mesh, options] { Stylize(mesh.positions, mesh.triangles, options); };
  };
  expect_refused(solve(cube_normals(), -1), "lambda");
  expect_refused(solve(cube_normals(), nan), "lambda");
  expect_refused(solve(ClosestNormals{}, 1), "style.normals: there is none");
  expect_refused(solve(ClosestNormals{Positions::Zero(2, 3)}, 1), "row 0 has no direction");
  expect_refused(solve(GivenNormals{Positions::Ones(3, 3)}, 1), "42 vertices");
  expect_refused(solve(GivenNormals{Positions::Ones(3, 3), true}, 1), "80 triangles");
  expect_refused(solve(GivenNormals{Positions::Constant(42, 3, nan)}, 1), "not finite");
  expect_refused(solve(Developable{-0.1}, 1), "tau");
  expect_refused(solve(Developable{0.1, -1}, 1), "threshold");
  expect_refused(solve(SphereMap{}, 1), "directions");
  expect_refused(solve(SphereMap{Positions::Ones(2, 3), {}, Positions::Ones(2, 3)}, 1), "triangles");
  expect_refused(with(by(arap, 0)), "pass_limit");
  StylizeOptions options;
  options.movement = -1;
  expect_refused(with(options), "movement");
  Gesture handles;
  handles.add(42, {0, 0, 0});
  EXPECT_THROW(stylize(mesh.positions, mesh.triangles, cube_normals(), 1, {}, handles), InvalidInput);
}

}  // namespace
}  // namespace swage::test
