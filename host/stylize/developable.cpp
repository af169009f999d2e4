// Normals that nearly unroll (paper appendix E; Stein, Grinspun, Crane: Developability of Triangle Meshes. SIGGRAPH
// 2018).
#include <utility>

#include "targets.h"

namespace swage {
namespace {

using Eigen::RowVector3d;

/// A normal without its part along the directions in which the normals around a vertex spread least.
RowVector3d projected(const RowVector3d& normal, const Transforms& directions, bool to_one, Eigen::Index vertex) {
  const RowVector3d weakest = directions.row(vertex).head<3>(), second = directions.row(vertex).segment<3>(3);
  RowVector3d result = normal - normal.dot(weakest) * weakest;
  if (to_one) result -= normal.dot(second) * second;
  return result;
}

}  // namespace

double mean_second_spread(const StylizePlan& plan, NormalFitStep& step) {
  Transforms directions;
  Positions spreads;
  step.fit(area_vectors(plan.elements.pairs.vertices, plan.mesh.triangles), directions, spreads);
  return spreads.col(1).sum() / spreads.sum();
}

Positions developable_normals(const StylizePlan& plan, NormalFitStep& step, const Developable& style, double least_part,
                              const Positions& positions) {
  const Triangles& triangles = plan.mesh.triangles;
  Positions normals = area_vectors(positions, triangles);
  Transforms directions;
  Positions spreads;
  step.fit(normals, directions, spreads);
  normals = normalised(std::move(normals));
  // As the authors' program: of twice the areas.
  const double threshold = style.threshold / (2 * plan.box.extent * plan.box.extent);
  const auto is_one = [&](Eigen::Index v) {
    return spreads(v, 1) < (threshold > 0 ? threshold : least_part * spreads.row(v).sum());
  };
  Positions targets(triangles.rows(), 3);
#pragma omp parallel for schedule(static)
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    RowVector3d sum = RowVector3d::Zero();
    for (int k = 0; k < 3; ++k) {
      const int v = triangles(t, k);
      sum += projected(normals.row(t), directions, is_one(v), v);
    }
    targets.row(t) = sum;
  }
  return normalised(std::move(targets));
}

}  // namespace swage
