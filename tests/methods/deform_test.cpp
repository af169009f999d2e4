// The deformations that reshaping is compared with: their closed forms, their minima, and any mesh.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <omp.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>

#include "adjacency.h"
#include "edit_measures.h"
#include "measures.h"
#include "opencl_device.h"
#include "shapes.h"
#include "swage/deform.h"
#include "swage/error.h"

namespace swage::test {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::HasSubstr;
using enum DeformMethod;

/// Every `stride`-th vertex goes where the similarity takes it.
Gesture carried_by(const Mesh& mesh, const Matrix3d& linear, const Vector3d& translation, int stride = 9) {
  Gesture gesture;
  for (int v = 0; v < mesh.positions.rows(); v += stride) {
    gesture.add(v, linear * mesh.positions.row(v).transpose() + translation);
  }
  return gesture;
}

Positions moved(const Mesh& mesh, const Matrix3d& linear, const Vector3d& translation) {
  return (mesh.positions * linear.transpose()).rowwise() + translation.transpose();
}

/// Every `stride`-th vertex is held, each moved another way.
Gesture uneven(const Mesh& mesh, double by, int stride = 15) {
  Gesture gesture;
  for (int v = 0; v < mesh.positions.rows(); v += stride) {
    gesture.add(v, mesh.positions.row(v).transpose() + by * Vector3d(std::sin(v), std::cos(2 * v), std::sin(3 * v)));
  }
  return gesture;
}

const Matrix3d kTurn = AngleAxisd(1.1, Vector3d(0.3, 1, -0.4).normalized()).toRotationMatrix();
const Vector3d kShift(0.7, -1.2, 0.4);

/// To the end.
DeformOptions thorough(DeformMethod method) {
  DeformOptions options;
  options.method = method;
  options.movement = 1e-10;
  options.pass_limit = 3000;
  return options;
}

/// Largest distance from `expected` in diagonals at rest.
double off(const Mesh& mesh, const Gesture& gesture, const DeformOptions& options, const Positions& expected) {
  const DeformResult result = deform(mesh.positions, mesh.triangles, gesture, options);
  return (result.positions - expected).rowwise().norm().maxCoeff() / box_diagonal(mesh.positions);
}

struct Shape {
  std::string name;
  Mesh mesh;
};

/// Three sheets that share an edge, one of them wound the other way, with a triangle twice, one without area, and a
/// vertex of none.
Mesh awkward() {
  const Mesh one = sheet(4);
  Mesh mesh = one;
  for (const double angle : {2.0, 4.0}) {
    Mesh other = one;
    other.positions = one.positions * AngleAxisd(angle, Vector3d::UnitX()).toRotationMatrix().transpose();
    if (angle > 3) other.triangles = Triangles(one.triangles.rowwise().reverse());
    mesh = joined(mesh, other);
  }
  const Eigen::Index count = mesh.triangles.rows();
  mesh.triangles.conservativeResize(count + 2, 3);
  mesh.triangles.row(count) = mesh.triangles.row(3);
  mesh.triangles.row(count + 1) << 0, 1, 0;
  mesh.positions.conservativeResize(mesh.positions.rows() + 1, 3);
  mesh.positions.bottomRows(1) << 0.3, 0.4, 2;
  return mesh;
}

std::vector<Shape> shapes() {
  const Mesh block = box({1, 2, 0.5}, 4);
  return {{"box", block},
          {"sheet", sheet(6)},
          {"torus", torus(1, 0.4, 24, 12)},
          {"apart", joined(block, transformed(block, 0.5, {2, 0.3, 0.1}))},
          {"touching", joined(block, transformed(block, 1, {1, 0, 0}))},
          {"crossing", joined(block, transformed(block, 1, {0.43, 0.31, 0.17}))},
          {"awkward", awkward()}};
}

class DeformShape : public testing::TestWithParam<Shape> {};

TEST_P(DeformShape, GoesWithARigidMotionOfItsHandles) {
  const Mesh& mesh = GetParam().mesh;
  const Gesture gesture = carried_by(mesh, kTurn, kShift);
  for (const DeformMethod method : {arap, arap_volume, conformal}) {
    EXPECT_LT(off(mesh, gesture, thorough(method), moved(mesh, kTurn, kShift)), 1e-6) << to_string(method);
  }
}

TEST_P(DeformShape, GoesWithASimilarityOfItsHandlesWhereItMayScale) {
  const Mesh& mesh = GetParam().mesh;
  const Matrix3d linear = 1.7 * kTurn;
  EXPECT_LT(off(mesh, carried_by(mesh, linear, kShift), thorough(conformal), moved(mesh, linear, kShift)), 1e-6);
  EXPECT_GT(off(mesh, carried_by(mesh, linear, kShift), thorough(arap), moved(mesh, linear, kShift)), 1e-2);
}

TEST_P(DeformShape, GoesWithATranslationOfOneHandle) {
  const Mesh& mesh = GetParam().mesh;
  Gesture gesture;
  gesture.add(5, mesh.positions.row(5).transpose() + kShift);
  for (const DeformMethod method : {poisson, arap, arap_volume, conformal}) {
    EXPECT_LT(off(mesh, gesture, thorough(method), moved(mesh, Matrix3d::Identity(), kShift)), 1e-9)
        << to_string(method);
  }
}

INSTANTIATE_TEST_SUITE_P(Any, DeformShape, testing::ValuesIn(shapes()),
                         [](const auto& instance) { return instance.param.name; });

/// The paper's appendix B, by a dense matrix.
Positions dense_poisson(const Mesh& unit_mesh, const Gesture& gesture, double handle_weight) {
  const Eigen::Index count = unit_mesh.positions.rows();
  const double weight = 1 / mean_edge_length(unit_mesh.positions, unit_mesh.triangles);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count, count);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(count, 3);
  for (const auto& t : unit_mesh.triangles.rowwise()) {
    for (int k = 0; k < 3; ++k) {
      Eigen::VectorXd difference = Eigen::VectorXd::Zero(count);
      difference[t[(k + 1) % 3]] += 1;
      difference[t[k]] -= 1;
      matrix += weight * difference * difference.transpose();
      right += weight * difference * (difference.transpose() * unit_mesh.positions);
    }
  }
  for (const auto& [v, target] : gesture.targets) {
    matrix(v, v) += handle_weight;
    right.row(v) += handle_weight * target.transpose();
  }
  return matrix.ldlt().solve(right);
}

TEST(Deform, PoissonIsThePapersMinimum) {
  const Mesh mesh = box({1, 0.6, 0.3}, 3);
  const Gesture gesture = move_top(mesh, {0.3, 0.5, -0.2});
  for (const double weight : {1e5, 10.0}) {
    DeformOptions options;
    options.method = poisson;
    options.handle_weight = weight;
    const Positions result = deform(mesh.positions, mesh.triangles, gesture, options).positions;
    EXPECT_LT((result - dense_poisson(mesh, gesture, weight)).cwiseAbs().maxCoeff(), 1e-9);
  }
}

/// Of each vertex's triangles by the cotangents of their angles, whatever rotation, or with a scale, suits best.
double spokes_and_rims(const Mesh& rest, const Positions& positions, bool scales) {
  double energy = 0;
  for (int v = 0; v < rest.positions.rows(); ++v) {
    Matrix3d covariance = Matrix3d::Zero();
    double before = 0, after = 0;
    for (const auto& t : rest.triangles.rowwise()) {
      if (t[0] != v && t[1] != v && t[2] != v) continue;
      for (int k = 0; k < 3; ++k) {
        const int i = t[k], j = t[(k + 1) % 3], o = t[(k + 2) % 3];
        const Vector3d a = rest.positions.row(i) - rest.positions.row(o),
                       b = rest.positions.row(j) - rest.positions.row(o);
        const double weight = a.dot(b) / a.cross(b).norm() / 2;
        const Vector3d e0 = b - a, e = positions.row(j) - positions.row(i);
        covariance += weight * e * e0.transpose();
        before += weight * e0.squaredNorm();
        after += weight * e.squaredNorm();
      }
    }
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Vector3d s = svd.singularValues();
    if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0) s[2] = -s[2];
    energy += scales ? after - std::pow(std::max(0.0, s.sum()), 2) / before : after - 2 * s.sum() + before;
  }
  return energy;
}

TEST(Deform, EndsWhereTheEnergyIsStationary) {
  const Mesh mesh = box({1, 0.7, 0.4}, 3);  // In the unit box already.
  const Gesture gesture = uneven(mesh, 0.1);
  for (const DeformMethod method : {arap, conformal}) {
    const Positions end = deform(mesh.positions, mesh.triangles, gesture, thorough(method)).positions;
    const auto energy = [&](const Positions& p) { return spokes_and_rims(mesh, p, method == conformal); };
    const double step = 1e-5, scale = energy(end);
    ASSERT_GT(scale, 1e-4);
    for (int v = 0; v < mesh.positions.rows(); v += 3) {
      if (gesture.targets.count(v) != 0) continue;
      for (int axis = 0; axis < 3; ++axis) {
        Positions forth = end, back = end;
        forth(v, axis) += step;
        back(v, axis) -= step;
        EXPECT_LT(std::abs(energy(forth) - energy(back)) / (2 * step), 1e-5) << to_string(method) << " vertex " << v;
      }
    }
  }
}

TEST(Deform, TellsTheEnergyThatItMinimises) {
  const Mesh mesh = box({1, 0.7, 0.4}, 3);
  const Gesture gesture = uneven(mesh, 0.1);
  for (const DeformMethod method : {arap, conformal}) {
    const DeformResult result = deform(mesh.positions, mesh.triangles, gesture, thorough(method));
    EXPECT_NEAR(result.report.energy, spokes_and_rims(mesh, result.positions, method == conformal), 1e-8);
    EXPECT_EQ(result.report.energy_by_term.at("edges"), result.report.energy);
  }
}

TEST(Deform, PlainPassesNeverRaiseTheEnergyAndAcceleratedOnesEndThere) {
  const Mesh mesh = cylinder(0.3, 1, 16, 8);
  const Gesture gesture = uneven(mesh, 0.1, 40);
  for (const DeformMethod method : {arap, arap_volume, conformal}) {
    DeformOptions options = thorough(method);
    const DeformResult accelerated = deform(mesh.positions, mesh.triangles, gesture, options);
    options.acceleration_window = 0;
    const DeformResult plain = deform(mesh.positions, mesh.triangles, gesture, options);
    const std::vector<double>& energies = plain.report.energies;
    for (size_t i = 1; i < energies.size(); ++i) EXPECT_LE(energies[i], energies[i - 1] + 1e-12) << to_string(method);
    EXPECT_LT(accelerated.report.passes, plain.report.passes) << to_string(method);
    EXPECT_LT(deviation(accelerated.positions, plain.positions).largest, 1e-6) << to_string(method);
  }
}

TEST(Deform, MeetsItsHandlesExactlyOrAsSoftlyAsAsked) {
  const Mesh mesh = torus(1, 0.4, 24, 12);
  const Gesture gesture = move_top(mesh, {0.4, 0.4, 0.2});
  DeformOptions options;
  const auto error = [&] {
    return handle_error(mesh, gesture, deform(mesh.positions, mesh.triangles, gesture, options).positions);
  };
  for (const DeformMethod method : {poisson, arap, arap_volume, conformal}) {
    options.method = method;
    options.handle_weight.reset();
    EXPECT_LT(error(), 1e-12) << to_string(method);
    options.handle_weight = 1e4;
    const double firm = error();
    options.handle_weight = 1;
    EXPECT_GT(error(), 10 * firm) << to_string(method);
    EXPECT_GT(firm, 1e-9) << to_string(method);
  }
}

TEST(Deform, SolvesAgainWithOrWithoutAStart) {
  const Mesh mesh = cylinder(0.3, 1, 16, 8);
  const Gesture first = uneven(mesh, 0.1, 40), second = uneven(mesh, 0.102, 40);
  for (const DeformMethod method : {poisson, arap, arap_volume, conformal}) {
    DeformOptions options;
    options.method = method;
    options.movement = 1e-8;
    Deform plan(mesh.positions, mesh.triangles, options);
    const DeformResult before = plan.solve(first), cold = plan.solve(second), warm = plan.solve(second, before);
    EXPECT_EQ(cold.positions, deform(mesh.positions, mesh.triangles, second, options).positions) << to_string(method);
    EXPECT_LT(deviation(warm.positions, cold.positions).largest, 1e-6) << to_string(method);
    EXPECT_TRUE(method == poisson || warm.report.passes <= cold.report.passes)
        << to_string(method) << ": " << warm.report.passes << " passes, from rest " << cold.report.passes;
    EXPECT_EQ(plan.solve(first).positions, before.positions);
  }
}

/// A filled cylinder keeps its section where it is bent; a hollow one collapses more.
TEST(Deform, AFillingKeepsVolume) {
  const Mesh mesh = cylinder(0.2, 2, 24, 24);
  Gesture gesture;
  for (int v = 0; v < mesh.positions.rows(); ++v) {
    const Vector3d p = mesh.positions.row(v);
    if (p.y() < 0.05) gesture.add(v, p);
    if (p.y() > 1.95) gesture.add(v, AngleAxisd(-2, Vector3d::UnitZ()) * (p - Vector3d(0, 2, 0)) + Vector3d(1.1, 1, 0));
  }
  const auto kept = [&](DeformMethod method) {
    const DeformResult result = deform(mesh.positions, mesh.triangles, gesture, thorough(method));
    return volume({result.positions, mesh.triangles}) / volume(mesh);
  };
  const double filled = kept(arap_volume), hollow = kept(arap);
  EXPECT_GT(filled, 0.9);
  EXPECT_LT(hollow, filled - 0.05);
}

TEST(Deform, AnOpenSheetHasNoFillingAndIsAShell) {
  const Mesh mesh = sheet(6);
  Gesture gesture = carried_by(mesh, Matrix3d::Identity(), Vector3d::Zero(), 20);
  gesture.targets.begin()->second += Vector3d(0, 0, 0.5);
  const DeformResult shell = deform(mesh.positions, mesh.triangles, gesture, thorough(arap_volume));
  EXPECT_LT(off(mesh, gesture, thorough(arap), shell.positions), 1e-7);
  EXPECT_THAT(shell.report.paths.at("filling"), HasSubstr("0 tetrahedra"));
}

TEST(Deform, TellsWhatTheMeshIs) {
  const Mesh mesh = awkward();
  const DeformResult result = deform(mesh.positions, mesh.triangles, carried_by(mesh, kTurn, kShift));
  std::string warnings;
  for (const std::string& warning : result.report.warnings) warnings += warning + "\n";
  for (const char* word : {"more than two triangles", "repeats", "two corners at one place", "no triangle"}) {
    EXPECT_THAT(warnings, HasSubstr(word));
  }
}

TEST(Deform, IsTheSameBytesOnOneThreadAndTwo) {
  const Mesh mesh = joined(torus(1, 0.4, 24, 12), transformed(box(), 1, {2, 0, 0}));
  const Gesture gesture = move_top(mesh, {0.4, 0.4, 0.2});
  const int threads = omp_get_max_threads();
  for (const DeformMethod method : {poisson, arap, arap_volume, conformal}) {
    DeformOptions options;
    options.method = method;
    omp_set_num_threads(1);
    const Positions one = deform(mesh.positions, mesh.triangles, gesture, options).positions;
    omp_set_num_threads(2);
    EXPECT_EQ(deform(mesh.positions, mesh.triangles, gesture, options).positions, one) << to_string(method);
  }
  omp_set_num_threads(threads);
}

TEST(Deform, OnADeviceIsAsOnTheReference) {
  const Mesh mesh = torus(1, 0.4, 24, 12);
  const Gesture gesture = move_top(mesh, {0.4, 0.4, 0.2});
  for (const Precision precision : {Precision::twice, Precision::single}) {
    const auto backend = opencl_or_skip(precision);
    if (!backend) return;
    for (const DeformMethod method : {arap, arap_volume, conformal}) {
      DeformOptions options;
      options.method = method;
      options.movement = 1e-6;
      const Positions reference = deform(mesh.positions, mesh.triangles, gesture, options).positions;
      options.backend = backend;
      const Positions device = deform(mesh.positions, mesh.triangles, gesture, options).positions;
      EXPECT_LT(deviation(device, reference).largest, 1e-4) << to_string(method);
    }
  }
}

TEST(Deform, CanBeCancelled) {
  const Mesh mesh = torus(1, 0.4, 24, 12);
  const Gesture gesture = move_top(mesh, {0.4, 0.4, 0.2});
  for (const DeformMethod method : {poisson, arap, arap_volume, conformal}) {
    DeformOptions options;
    options.method = method;
    Deform plan(mesh.positions, mesh.triangles, options);
    EXPECT_FALSE(plan.prepare([](const Progress&) { return false; }));
    const DeformResult result = plan.solve(gesture, [](const Progress&) { return false; });
    EXPECT_EQ(result.report.stop, Termination::cancelled);
    EXPECT_EQ(result.positions, mesh.positions);
    double last = 0;
    plan.solve(gesture, [&](const Progress& now) {
      EXPECT_GE(now.fraction, last);
      EXPECT_LE(now.fraction, 1);
      last = now.fraction;
      return true;
    });
    EXPECT_GT(last, 0);
  }
}

template <class Call>
std::string refusal(const Call& call) {
  try {
    call();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "nothing";
}

TEST(Deform, RefusesWhatItCannotDo) {
  const Mesh mesh = sheet(2);
  const Gesture gesture = move_top(mesh, {0, 0, 1});
  const auto with = [&](const auto& set) {
    DeformOptions options;
    set(options);
    return refusal([&] { Deform(mesh.positions, mesh.triangles, options); });
  };
  EXPECT_THAT(with([](auto& o) { o.handle_weight = 0; }), HasSubstr("handle_weight"));
  EXPECT_THAT(with([](auto& o) { o.handle_weight = std::nan(""); }), HasSubstr("handle_weight"));
  EXPECT_THAT(with([](auto& o) { o.pass_limit = 0; }), HasSubstr("pass_limit"));
  EXPECT_THAT(with([](auto& o) { o.movement = 0; }), HasSubstr("movement"));
  EXPECT_THAT(with([](auto& o) { o.acceleration_window = -1; }), HasSubstr("acceleration_window"));
  EXPECT_THAT(with([](auto& o) { o.filling_time_limit = 0; }), HasSubstr("filling_time_limit"));
  Mesh flat = mesh;
  flat.positions.col(0).setZero();
  flat.positions.col(2).setZero();
  EXPECT_THAT(refusal([&] { Deform(flat.positions, flat.triangles); }), HasSubstr("Deform: triangles: none"));
  Deform plan(mesh.positions, mesh.triangles);
  EXPECT_THAT(refusal([&] { plan.solve({}); }), HasSubstr("handle"));
  EXPECT_THAT(refusal([&] { plan.solve(gesture, DeformResult{Positions::Zero(3, 3), {}}); }), HasSubstr("3 rows"));
  DeformResult start{mesh.positions, {}};
  start.positions(1, 1) = std::nan("");
  EXPECT_THAT(refusal([&] { plan.solve(gesture, start); }), HasSubstr("not finite"));
}

}  // namespace
}  // namespace swage::test
