// The map's scales, the grid they make, and the model in it.
#include <algorithm>
#include <utility>

#include "carry.h"
#include "energy.h"
#include "plan.h"
#include "vulnerability.h"

namespace swage {
namespace {

/// How far the box's lower corner goes.
Eigen::RowVector3d shift_of(const GridShape& shape, const ResizeTarget& target) {
  Eigen::RowVector3d shift = Eigen::RowVector3d::Zero();
  for (int u = 0; u < 3; ++u) {
    const ResizeAnchor anchor = target.anchors[static_cast<size_t>(u)];
    const double part = anchor == ResizeAnchor::low ? 0 : anchor == ResizeAnchor::center ? 0.5 : 1;
    if (shape.extends(u)) shift[u] = part * (1 - target.factors[u]) * shape.size[u];
  }
  return shift;
}

ResizeResult unchanged(const ResizePlan& plan, Termination stop) {
  ResizeResult result;
  result.positions = plan.mesh->positions;
  result.scales = AxisValues::Ones(plan.shape.cells.count(), 3);
  result.grid = rest_vertices(plan.shape);
  result.report.stop = stop;
  return result;
}

double least_edge(const GridShape& shape, const AxisValues& vertices) {
  const Extents grid = shape.vertices();
  double least = INFINITY;
  for (int u = 0; u < 3; ++u) {
    if (!shape.extends(u)) continue;
    for (Eigen::Index v = 0; v + grid.stride(u) < grid.count(); ++v) {
      if (v / grid.stride(u) % grid[u] == grid[u] - 1) continue;
      const double edge = vertices(v + grid.stride(u), u) - vertices(v, u);
      least = std::min(least, edge * shape.cells[u] / shape.size[u]);
    }
  }
  return least;
}

Eigen::RowVector3d kept_scale(const CellMap& map, const AxisValues& scales) {
  const Eigen::RowVector3d sums = map.theta.cwiseProduct(scales).colwise().sum(), weights = map.theta.colwise().sum();
  return (weights.array() > 0).select(sums.cwiseQuotient(weights), Eigen::RowVector3d::Ones());
}

ResizeTarget effective(const GridShape& shape, ResizeTarget target) {
  for (int u = 0; u < 3; ++u) target.factors[u] = shape.extends(u) ? target.factors[u] : 1;
  return target;
}

ResizeResult solve_prepared(ResizePlan& plan, const ResizeTarget& target, Stages& stages) {
  ResizeResult result;
  result.factors = target.factors;
  std::map<std::string, double>& seconds = result.report.seconds;
  stages.begin("grid", 0);
  const GridSolves& solves = solves_of(plan);

  stages.begin("scales", 0.05);
  const ScaleOptions options = {target.keep == ResizeKeep::size ? target.size_weight : 0, plan.options.tolerance};
  Scales scales;
  {
    const Stopwatch watch(seconds["scales"]);
    scales = solves.scales.solve(target.factors, options, stages.poll());
  }
  stages.begin("assembly", 0.5);
  GridVertices grid;
  {
    const Stopwatch watch(seconds["assembly"]);
    grid = solves.assembly.place(scales.values, target.factors, {plan.options.tolerance}, stages.poll());
  }
  stages.begin("carry", 0.9);
  grid.positions.rowwise() += shift_of(plan.shape, target);
  {
    const Stopwatch watch(seconds["carry"]);
    result.positions = carry(plan.shape, grid.positions, plan.mesh, *plan.options.backend);
  }

  result.least_scale = scales.values.minCoeff();
  result.least_edge = least_edge(plan.shape, grid.positions);
  result.kept_scale = kept_scale(plan.map, scales.values);
  result.scales_at_bound = scales.at_bound;
  result.edges_at_bound = grid.at_bound;
  const bool converged = scales.converged && grid.converged;
  result.report.stop = converged ? Termination::energy_settled : Termination::pass_limit;
  result.report.passes = scales.iterations + grid.iterations;
  result.report.energy_by_term = energy_by_term(plan.shape, plan.map, target, scales.values, grid.positions);
  for (const auto& [term, energy] : result.report.energy_by_term) result.report.energy += energy;
  result.scales = std::move(scales.values);
  result.grid = std::move(grid.positions);
  return result;
}

}  // namespace

Resize::Resize(const PositionsRef& positions, const TrianglesRef& triangles, const ResizeOptions& options) {
  check(positions, triangles);
  check_options(positions, options);
  plan_.reset(
      new ResizePlan{options, std::make_shared<Mesh>(Mesh{positions, triangles}), shape_of(positions, options)});
  if (!plan_->options.backend) plan_->options.backend = cpu_backend();
}
Resize::~Resize() = default;
Resize::Resize(Resize&&) noexcept = default;
Resize& Resize::operator=(Resize&&) noexcept = default;

bool Resize::prepare(const ProgressFn& progress) { return swage::prepare(*plan_, progress); }

const GridShape& Resize::shape() const { return plan_->shape; }

const Vulnerability& Resize::vulnerability() {
  prepare();
  return plan_->vulnerability;
}

const CellMap& Resize::map() {
  prepare();
  return plan_->map;
}

void Resize::protect(const Protection& protection) {
  prepare();
  swage::protect(*plan_, protection);
}

void Resize::set_map(const CellMap& map) {
  check("Resize", plan_->shape, map);
  prepare();
  plan_->map.phi = map.phi;
  plan_->said = map.theta;
  count_map(*plan_);
}

void Resize::reset_map() {
  prepare();
  swage::reset_map(*plan_);
}

ResizeResult Resize::solve(const ResizeTarget& given, const ProgressFn& progress) {
  check_target(plan_->shape, given);
  const ResizeTarget target = effective(plan_->shape, given);
  double seconds = 0;
  ResizeResult result;
  try {
    if (!prepare(progress)) throw Cancelled();
    const Stopwatch watch(seconds);
    const ProgressFn rest = after_preparation(progress);
    Stages stages(rest, 1, 1);
    result = solve_prepared(*plan_, target, stages);
  } catch (const Cancelled&) {
    result = unchanged(*plan_, Termination::cancelled);
  }
  result.report.seconds.insert(plan_->seconds.begin(), plan_->seconds.end());
  result.report.seconds["precompute"] = plan_->seconds["vulnerability"] + plan_->seconds["coverage"];
  result.report.seconds["solve"] = seconds;
  tell(*plan_, given, result);
  return result;
}

ResizeResult resize(const PositionsRef& positions, const TrianglesRef& triangles, const ResizeTarget& target,
                    const ResizeOptions& options, const ProgressFn& progress) {
  return Resize(positions, triangles, options).solve(target, progress);
}

}  // namespace swage
