// Normals that nearly unroll (paper appendix E; Stein, Grinspun, Crane: Developability of Triangle Meshes. SIGGRAPH
// 2018).
#include <Eigen/Eigenvalues>
#include <utility>

#include "directions.h"
#include "targets.h"

namespace swage {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;

/// Takes from a normal its part along the directions in which the normals around a vertex spread least.
Matrix3d projection(const Matrix3d& moment, double least_part, double threshold) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(moment);
  const auto weakest = solver.eigenvectors().col(0), second = solver.eigenvectors().col(1);
  Matrix3d result = Matrix3d::Identity() - weakest * weakest.transpose();
  const double least = threshold > 0 ? threshold : least_part * moment.trace();
  if (solver.eigenvalues()[1] < least) result -= second * second.transpose();
  return result;
}

}  // namespace

double mean_second_spread(const StylizePlan& plan) {
  const Positions areas = area_vectors(plan.elements.pairs.vertices, plan.mesh.triangles);
  const Positions normals = normalised(areas);
  double second = 0, all = 0;
  for (int v = 0; v < plan.triangles_around.size(); ++v) {
    Matrix3d moment = Matrix3d::Zero();
    for (const int t : plan.triangles_around[v]) moment += areas.row(t).transpose() * normals.row(t);
    second += moment.selfadjointView<Eigen::Lower>().eigenvalues()[1];
    all += moment.trace();
  }
  return second / all;
}

Positions developable_normals(const StylizePlan& plan, const Developable& style, double least_part,
                              const Positions& positions) {
  const Triangles& triangles = plan.mesh.triangles;
  Positions normals = area_vectors(positions, triangles);
  const Eigen::VectorXd areas = normals.rowwise().norm() / 2;
  normals = normalised(std::move(normals));
  // As the authors' program: of twice the areas.
  const double threshold = style.threshold / (2 * plan.box.extent * plan.box.extent);
  Transforms projections(positions.rows(), 9);
#pragma omp parallel for schedule(static)
  for (int v = 0; v < static_cast<int>(positions.rows()); ++v) {
    Matrix3d moment = Matrix3d::Zero();
    for (const int t : plan.triangles_around[v]) moment += areas[t] * normals.row(t).transpose() * normals.row(t);
    Eigen::Map<Matrix3d>(projections.row(v).data()) = projection(moment, least_part, threshold);
  }
  Positions targets(triangles.rows(), 3);
#pragma omp parallel for schedule(static)
  for (Index t = 0; t < triangles.rows(); ++t) {
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    for (int k = 0; k < 3; ++k) {
      sum += normals.row(t) * Eigen::Map<const Matrix3d>(projections.row(triangles(t, k)).data());
    }
    targets.row(t) = sum;
  }
  return normalised(std::move(targets));
}

}  // namespace swage
