// What the deformations that reshaping is compared with find: closed forms and minima, of any mesh.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>

#include "adjacency.h"
#include "edit_measures.h"
#include "gestures.h"
#include "measures.h"
#include "shapes.h"
#include "swage/deform.h"

namespace swage::test {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::HasSubstr;

Positions moved(const Mesh& mesh, const Matrix3d& linear, const Vector3d& translation) {
  return (mesh.positions * linear.transpose()).rowwise() + translation.transpose();
}

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
double off_expected(const Mesh& mesh, const Gesture& gesture, const DeformOptions& options, const Positions& expected) {
  const DeformResult result = deform(mesh.positions, mesh.triangles, gesture, options);
  return (result.positions - expected).rowwise().norm().maxCoeff() / box_diagonal(mesh.positions);
}

std::vector<NamedMesh> meshes_to_deform() {
  const Mesh block = box({1, 2, 0.5}, 4);
  return {{"box", block},
          {"sheet", sheet(6)},
          {"torus", torus(1, 0.4, 24, 12)},
          {"apart", joined(block, transformed(block, 0.5, {2, 0.3, 0.1}))},
          {"touching", joined(block, transformed(block, 1, {1, 0, 0}))},
          {"crossing", joined(block, transformed(block, 1, {0.43, 0.31, 0.17}))},
          {"awkward", awkward()}};
}

class DeformShape : public testing::TestWithParam<NamedMesh> {};

TEST_P(DeformShape, GoesWithARigidMotionOfItsHandles) {
  const Mesh& mesh = GetParam().mesh;
  const Gesture gesture = carried_by(mesh, kTurn, kShift);
  for (const DeformMethod method : {DeformMethod::arap, DeformMethod::arap_volume, DeformMethod::conformal}) {
    EXPECT_LT(off_expected(mesh, gesture, thorough(method), moved(mesh, kTurn, kShift)), 1e-6) << to_string(method);
  }
}

TEST_P(DeformShape, GoesWithASimilarityOfItsHandlesWhereItMayScale) {
  const Mesh& mesh = GetParam().mesh;
  const Matrix3d linear = 1.7 * kTurn;
  EXPECT_LT(off_expected(mesh, carried_by(mesh, linear, kShift), thorough(DeformMethod::conformal),
                         moved(mesh, linear, kShift)),
            1e-6);
  EXPECT_GT(
      off_expected(mesh, carried_by(mesh, linear, kShift), thorough(DeformMethod::arap), moved(mesh, linear, kShift)),
      1e-2);
}

TEST_P(DeformShape, GoesWithATranslationOfOneHandle) {
  const Mesh& mesh = GetParam().mesh;
  Gesture gesture;
  gesture.add(5, mesh.positions.row(5).transpose() + kShift);
  for (const DeformMethod method :
       {DeformMethod::poisson, DeformMethod::arap, DeformMethod::arap_volume, DeformMethod::conformal}) {
    EXPECT_LT(off_expected(mesh, gesture, thorough(method), moved(mesh, Matrix3d::Identity(), kShift)), 1e-9)
        << to_string(method);
  }
}

INSTANTIATE_TEST_SUITE_P(Any, DeformShape, testing::ValuesIn(meshes_to_deform()),
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
    options.method = DeformMethod::poisson;
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
  for (const DeformMethod method : {DeformMethod::arap, DeformMethod::conformal}) {
    const Positions end = deform(mesh.positions, mesh.triangles, gesture, thorough(method)).positions;
    const auto energy = [&](const Positions& p) { return spokes_and_rims(mesh, p, method == DeformMethod::conformal); };
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
  for (const DeformMethod method : {DeformMethod::arap, DeformMethod::conformal}) {
    const DeformResult result = deform(mesh.positions, mesh.triangles, gesture, thorough(method));
    EXPECT_NEAR(result.report.energy, spokes_and_rims(mesh, result.positions, method == DeformMethod::conformal), 1e-8);
    EXPECT_EQ(result.report.energy_by_term.at("edges"), result.report.energy);
  }
}

TEST(Deform, PlainPassesNeverRaiseTheEnergyAndAcceleratedOnesEndThere) {
  const Mesh mesh = cylinder(0.3, 1, 16, 8);
  const Gesture gesture = uneven(mesh, 0.1, 40);
  for (const DeformMethod method : {DeformMethod::arap, DeformMethod::arap_volume, DeformMethod::conformal}) {
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
  const double filled = kept(DeformMethod::arap_volume), hollow = kept(DeformMethod::arap);
  EXPECT_GT(filled, 0.9);
  EXPECT_LT(hollow, filled - 0.05);
}

TEST(Deform, AnOpenSheetHasNoFillingAndIsAShell) {
  const Mesh mesh = sheet(6);
  Gesture gesture = carried_by(mesh, Matrix3d::Identity(), Vector3d::Zero(), 20);
  gesture.targets.begin()->second += Vector3d(0, 0, 0.5);
  const DeformResult shell = deform(mesh.positions, mesh.triangles, gesture, thorough(DeformMethod::arap_volume));
  EXPECT_LT(off_expected(mesh, gesture, thorough(DeformMethod::arap), shell.positions), 1e-7);
  EXPECT_THAT(shell.report.paths.at("filling"), HasSubstr("0 tetrahedra"));
}

}  // namespace
}  // namespace swage::test
