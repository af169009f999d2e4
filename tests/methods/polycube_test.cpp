// PolyCubes and other boxes: what the method promises, on generated shapes.
#include "swage/polycube.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <omp.h>

#include <Eigen/Geometry>
#include <cmath>

#include "place_and_size.h"
#include "shapes.h"
#include "stylized.h"
#include "swage/error.h"

namespace swage::test {
namespace {

using testing::HasSubstr;

StylizeResult boxed(const Mesh& mesh, const PolycubeOptions& options = {}, const Gesture& handles = {}) {
  return polycube(mesh.positions, mesh.triangles, cube_normals(), options, handles);
}

PolycubeOptions passes(int limit) {
  PolycubeOptions options;
  options.pass_limit = limit;
  return options;
}

/// An open sheet bent to a saddle.
Mesh saddle() {
  Mesh mesh = sheet(24);
  mesh.positions.col(2) =
      1.5 * (mesh.positions.col(0).array() - 0.5).square() - 1.5 * (mesh.positions.col(1).array() - 0.5).square();
  return mesh;
}

struct Boxed {
  std::string name;
  Mesh mesh;
  double within_5;  // Share of the area, of degrees from a normal; measured, less a hundredth or two.
};

std::vector<Boxed> meshes_to_box() {
  return {{"sphere", askew(sphere(1, 4)), 0.985},
          {"torus", askew(torus(1, 0.4, 48, 24)), 0.95},
          {"bumpy", askew(bumpy_sphere(0.05)), 0.96},
          {"cylinder", askew(cylinder(0.5, 1.5, 48, 24)), 0.985},
          {"saddle", askew(saddle()), 0.9},
          {"apart", askew(joined(sphere(1, 3), transformed(torus(1, 0.4, 30, 15), 0.7, {3, 0, 0}))), 0.95}};
}

class PolycubeShape : public testing::TestWithParam<Boxed> {};

TEST_P(PolycubeShape, TurnsNearlyAllOfItsSurfaceToTheNormals) {
  const auto& [name, mesh, within_5] = GetParam();
  const StylizeResult result = boxed(mesh);
  const Positions normals = cube_normals().normals;
  EXPECT_GT(share_near(mesh, result.positions, normals, 5), within_5);
  EXPECT_LT(mean_angle(mesh, result.positions, normals), 0.1 * mean_angle(mesh, mesh.positions, normals));
  EXPECT_LT(result.report.passes, 50);
}

TEST_P(PolycubeShape, KeepsItsTriangles) {
  const Mesh& mesh = GetParam().mesh;
  const StylizeResult result = boxed(mesh);
  EXPECT_EQ(turned_over(mesh, result.positions), 0);
  EXPECT_GT(least_angle(mesh, result.positions), 1.9);
}

TEST_P(PolycubeShape, LowersItsEnergyUntilItStops) {
  const Report report = boxed(GetParam().mesh).report;
  for (size_t i = 1; i + 1 < report.energies.size(); ++i) EXPECT_LT(report.energies[i], report.energies[i - 1]);
  EXPECT_EQ(report.energy, report.energies[static_cast<size_t>(report.best_pass)]);
  EXPECT_THAT(report.stop, testing::AnyOf(Termination::energy_settled, Termination::energy_rose));
}

TEST_P(PolycubeShape, GoesWithMotionsOfItselfAndItsStyle) {
  const Mesh& mesh = GetParam().mesh;
  const auto moved = [](const Positions& positions) -> Positions {
    return (2.5 * positions * kTurn.transpose()).rowwise() + Eigen::RowVector3d(0.7, -1.2, 0.4);
  };
  ClosestNormals turned = cube_normals();
  turned.normals *= kTurn.transpose();
  const Positions here = boxed(mesh, passes(3)).positions;
  const Positions there = polycube(moved(mesh.positions), mesh.triangles, turned, passes(3)).positions;
  EXPECT_LT(far_apart(moved(here), there), 1e-8);
}

INSTANTIATE_TEST_SUITE_P(Any, PolycubeShape, testing::ValuesIn(meshes_to_box()),
                         [](const auto& instance) { return instance.param.name; });

TEST(Polycube, DissolvesDetailsThatStylizingKeeps) {
  const Mesh mesh = askew(bumpy_sphere(0.08));
  StylizeOptions options;
  options.energy = StylizeEnergy::farap;
  const Positions normals = cube_normals().normals;
  const Positions kept = stylize(mesh.positions, mesh.triangles, cube_normals(), 10, options).positions;
  const Positions dissolved = boxed(mesh).positions;
  EXPECT_LT(mean_angle(mesh, dissolved, normals), 0.3 * mean_angle(mesh, kept, normals));
}

TEST(Polycube, LeavesABoxABox) {
  const Mesh mesh = box({1, 2, 0.5}, 6);
  EXPECT_LT(far_apart(mesh.positions, boxed(mesh).positions), 1e-12);
}

TEST(Polycube, MakesAHexagonalPrismOfACylinder) {
  const Mesh mesh = transformed(cylinder(0.5, 1.2, 60, 20), 1, {0, -0.6, 0});
  ClosestNormals style = closest_normals(prism(6));
  style.normals = style.normals(Eigen::all, {0, 2, 1}).eval();  // About the cylinder's axis, y.
  const Positions result = polycube(mesh.positions, mesh.triangles, style).positions;
  EXPECT_GT(share_near(mesh, result, style.normals, 5), 0.97);
  EXPECT_EQ(turned_over(mesh, result), 0);
  EXPECT_LT(share_near(mesh, result, cube_normals().normals, 5), 0.75);
}

TEST(Polycube, KeepsThePlaceAndSizeOfEachComponent) {
  const Mesh one = askew(sphere(1, 3)), other = transformed(askew(torus(1, 0.4, 30, 15)), 0.5, {3, 1, 0});
  const Positions result = boxed(joined(one, other)).positions;
  const auto place_and_size = [](const Mesh& mesh, const Positions& positions) {
    StylizeOptions options;
    const auto plan = plan_of({mesh.positions, mesh.triangles}, options);
    prepare(*plan, {});
    return places_and_sizes(*plan, positions).front();
  };
  const auto expect_kept = [&](const Mesh& mesh, const Positions& positions) {
    const PlaceAndSize before = place_and_size(mesh, mesh.positions), now = place_and_size(mesh, positions);
    EXPECT_LT((before.centre - now.centre).norm(), 1e-9);
    EXPECT_NEAR(before.spread, now.spread, 1e-9);
    EXPECT_NEAR(volume({positions, mesh.triangles}) / volume(mesh), 0.9, 0.15);
  };
  expect_kept(one, result.topRows(one.positions.rows()));
  expect_kept(other, result.bottomRows(other.positions.rows()));
}

TEST(Polycube, MeetsItsHandles) {
  const Mesh mesh = askew(sphere(1, 3));
  Gesture handles;
  for (int v = 0; v < mesh.positions.rows(); ++v) {
    const Eigen::Vector3d at = mesh.positions.row(v);
    if (at[1] < -0.95) handles.add(v, at);
    if (at[1] > 0.95) handles.add(v, at + Eigen::Vector3d(0, 0.8, 0));
  }
  const StylizeResult result = boxed(mesh, {}, handles);
  for (const auto& [vertex, target] : handles.targets) {
    EXPECT_LT((result.positions.row(vertex).transpose() - target).norm(), 1e-12);
  }
  EXPECT_GT(share_near(mesh, result.positions, cube_normals().normals, 10), 0.9);
}

TEST(Polycube, TakesAnyListOfTriangles) {
  for (const Mesh& mesh : {awkward(), joined(sphere(1, 2), awkward())}) {
    const StylizeResult result = boxed(mesh);
    EXPECT_EQ(result.positions.rows(), mesh.positions.rows());
    EXPECT_TRUE(result.positions.allFinite());
    EXPECT_FALSE(result.report.warnings.empty());
  }
}

TEST(Polycube, StopsWhereItsCallerCancels) {
  const Mesh mesh = askew(sphere(1, 2));
  for (const int last : {0, 1, 3, 6}) {
    int asked = 0;
    const StylizeResult result = polycube(mesh.positions, mesh.triangles, cube_normals(), {}, {},
                                          [&](const Progress&) { return asked++ < last; });
    EXPECT_EQ(result.report.stop, Termination::cancelled);
    EXPECT_EQ(result.positions.rows(), mesh.positions.rows());
    if (result.report.passes == 0) {
      EXPECT_EQ(result.positions, mesh.positions);
    }
  }
}

TEST(Polycube, IsTheSameBytesOnOneThreadAndTwo) {
  const Mesh mesh = askew(torus(1, 0.4, 48, 24));
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const Positions one = boxed(mesh, passes(4)).positions;
  omp_set_num_threads(2);
  EXPECT_EQ(one, boxed(mesh, passes(4)).positions);
  omp_set_num_threads(threads);
}

TEST(Polycube, RefusesWhatItCannotTake) {
  const Mesh mesh = sphere(1, 1);
  const auto refused = [&](const PolycubeOptions& options, const ClosestNormals& style, const char* words) {
    try {
      polycube(mesh.positions, mesh.triangles, style, options);
      ADD_FAILURE() << "not refused: " << words;
    } catch (const InvalidInput& refusal) {
      EXPECT_THAT(refusal.what(), HasSubstr(words));
      EXPECT_THAT(refusal.what(), HasSubstr("polycube"));
    }
  };
  PolycubeOptions options;
  options.lambda = 0;
  refused(options, cube_normals(), "lambda");
  refused(passes(0), cube_normals(), "pass_limit");
  options = {};
  options.energy_drop = -1;
  refused(options, cube_normals(), "energy_drop");
  options = {};
  options.least_angle = 1;
  refused(options, cube_normals(), "least_angle");
  refused({}, ClosestNormals{}, "there is none");
  refused({}, ClosestNormals{Positions::Zero(2, 3)}, "row 0 has no direction");
  Gesture handles;
  handles.add(42, {0, 0, 0});
  EXPECT_THROW(boxed(mesh, {}, handles), InvalidInput);
}

}  // namespace
}  // namespace swage::test
