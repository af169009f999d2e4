// From a model to its grid's map.
#include <algorithm>
#include <cmath>

#include "coverage.h"
#include "enclosed.h"
#include "plan.h"
#include "vulnerability.h"

namespace swage {
namespace {

using Eigen::Index;

constexpr double kFlat = 1e-9;      // Of the diagonal: thinner boxes have no extent.
constexpr double kUntouched = 0.5;  // phi of cells that no face touches: what is hollow keeps its shape as well.

CellMap map_of(const ResizePlan& plan, const Poll& poll) {
  const AxisValues& theta = plan.vulnerability.theta;
  const Index count = plan.shape.cells.count();
  CellMap map{AxisValues::Zero(count, 3), Eigen::VectorXd::Constant(count, kUntouched)};
  each_coverage(plan.shape, plan.mesh, *plan.options.backend, poll, [&](Index t, std::span<const int> cells) {
    for (const int c : cells) {
      map.theta.row(c) = map.theta.row(c).cwiseMax(theta.row(t));
      map.phi[c] = 1;
    }
  });
  return map;
}

}  // namespace

GridShape shape_of(const PositionsRef& positions, const ResizeOptions& options) {
  const Eigen::RowVector3d low = positions.colwise().minCoeff(), high = positions.colwise().maxCoeff();
  GridShape shape{{{1, 1, 1}}, low, high - low};
  const double flat = kFlat * shape.size.norm();
  double width = 0;  // Of a cell.
  for (int u = 0; u < 3; ++u) {
    if (shape.size[u] <= flat) shape.size[u] = 0;
    const int asked = options.cells[static_cast<size_t>(u)];
    if (asked > 0 && shape.extends(u)) width = std::max(width, shape.size[u] / asked);
  }
  if (width == 0) width = shape.size.maxCoeff() / options.longest;
  for (int u = 0; u < 3; ++u) {
    if (!shape.extends(u)) continue;
    const int asked = options.cells[static_cast<size_t>(u)];
    const double fit = std::min(shape.size[u] / width, 1e6);
    shape.cells[u] = asked > 0 ? asked : std::max(kFewestCells, static_cast<int>(std::lround(fit)));
  }
  return shape;
}

bool prepare(ResizePlan& plan, const ProgressFn& progress) {
  return prepare_once(plan, [&](ResizePlan& made) {
    Preparation stages(progress, 1);
    stages.begin("vulnerability", 0);
    {
      const Stopwatch watch(made.seconds["vulnerability"] = 0);
      made.vulnerability = vulnerability(made.mesh->positions, made.mesh->triangles, made.options.vulnerability,
                                         *made.options.backend, stages.poll());
    }
    stages.begin("coverage", 0.8);
    const Stopwatch watch(made.seconds["coverage"] = 0);
    made.found = map_of(made, stages.poll());
    reset_map(made);
  });
}

void reset_map(ResizePlan& plan) {
  plan.map.phi = plan.found.phi;
  plan.said.setConstant(plan.shape.cells.count(), 3, -1);
  count_map(plan);
}

void count_map(ResizePlan& plan) {
  const auto is_said = plan.said.array() >= 0;
  plan.map.theta = is_said.select(plan.said, plan.found.theta);
  protect_enclosed(plan.shape, plan.map);
  plan.map.theta = is_said.select(plan.said, plan.map.theta);
  plan.solves.reset();
}

const GridSolves& solves_of(ResizePlan& plan) {
  const std::lock_guard lock(plan.preparing);
  if (!plan.solves) {
    const Stopwatch watch(plan.seconds["grid"] = 0);
    plan.solves.reset(new GridSolves{ScaleSolve(plan.shape, plan.map), Assembly(plan.shape, plan.map)});
  }
  return *plan.solves;
}

}  // namespace swage
