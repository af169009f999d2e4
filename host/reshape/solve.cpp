#include <numeric>
#include <string>

#include "alternate.h"
#include "anderson.h"
#include "plan.h"

namespace swage {
namespace {

constexpr double kPrepared = 0.2;  // Of a whole call's progress.
constexpr int kPlainPasses = 2;    // Far from the fixed point, and unlike those after: nothing to learn from.

Holds handles_of(const Gesture& gesture, const UnitBox& box, double weight) {
  Holds handles{{}, Positions(static_cast<Eigen::Index>(gesture.targets.size()), 3), weight};
  for (const auto& [vertex, target] : gesture.targets) {
    handles.targets.row(static_cast<Eigen::Index>(handles.vertices.size())) =
        (target.transpose() - box.corner) / box.extent;
    handles.vertices.push_back(vertex);
  }
  return handles;
}

Iterate start(ReshapePlan& plan, const Gesture& gesture) {
  Iterate iterate;
  iterate.acceleration = Anderson(plan.options.acceleration_window);
  iterate.handles = handles_of(gesture, plan.box, plan.weights.handle);
  iterate.transforms = identities(plan.mesh.triangles.rows());
  plan.step->reset();
  plan.vertices->system.forget_factor();
  return iterate;
}

StopRule stop_rule(const ReshapePlan& plan) {
  StopRule stop;
  stop.pass_limit = plan.options.pass_limit;
  if (plan.options.solver == ReshapeSolver::steady) {
    stop.by_energy = false;
    stop.movement = plan.options.movement * plan.rest.mean_edge_length;
    return stop;
  }
  stop.movement = plan.rest.mean_edge_length / 100;
  stop.energy_drop = 0.01 / static_cast<double>(plan.edges.vertices.rows());
  return stop;
}

/// The published passes are never others, whatever a build has.
std::optional<FactorKind> factor_kind(const ReshapeOptions& options) {
  if (options.solver == ReshapeSolver::published) return FactorKind::simplicial;
  return std::nullopt;
}

double place(ReshapePlan& plan, Iterate& iterate, Positions& positions) {
  const Stopwatch watch(iterate.seconds["vertex_step"]);
  plan.step->fit_edges(iterate.transforms, iterate.quadratics);
  iterate.singular = std::max(iterate.singular, iterate.quadratics.singular);
  iterate.before = positions;
  // The published passes solve exactly.
  if (plan.options.solver == ReshapeSolver::published) plan.vertices->system.forget_factor();
  positions = place_vertices(*plan.vertices, plan.rest, iterate.quadratics, plan.straight, plan.weights.straightness,
                             {iterate.handles}, iterate.before);
  const TransformStep::Energy local = plan.step->fit_transforms(positions, iterate.right_hand_sides);
  iterate.energy_by_term.push_back(energy_terms(local, positions, plan.straight, plan.weights, iterate.handles));
  return sum(iterate.energy_by_term.back());
}

/// The right-hand sides are those of the positions last placed; of a start combined from several they are made anew.
Positions next_start(ReshapePlan& plan, Iterate& iterate, const Positions& start, const Positions& end) {
  const Stopwatch watch(iterate.seconds["acceleration"]);
  if (iterate.energy_by_term.size() < kPlainPasses) return end;
  Positions next = iterate.acceleration.next(start, end);
  plan.step->fit_transforms(next, iterate.right_hand_sides);
  return next;
}

void fit(ReshapePlan& plan, Iterate& iterate) {
  const Stopwatch watch(iterate.seconds["transform_step"]);
  if (plan.options.refactor_every_pass) plan.transforms->factor();
  iterate.transforms = plan.transforms->single()
                           ? improved_transforms(*plan.transforms, iterate.right_hand_sides, iterate.transforms)
                           : solve_transforms(*plan.transforms, iterate.right_hand_sides);
}

void tell(const ReshapePlan& plan, const Iterate& iterate, Report& report) {
  if (report.passes > 0) report.energy_by_term = iterate.energy_by_term[static_cast<size_t>(report.best_pass)];
  report.seconds = iterate.seconds;
  report.seconds["precompute"] = plan.prepare_seconds;
  report.seconds["solve"] = std::accumulate(iterate.seconds.begin(), iterate.seconds.end(), 0.0,
                                            [](double sum, const auto& stage) { return sum + stage.second; });
  if (iterate.singular > 0) {
    report.warnings.push_back("in a pass " + std::to_string(iterate.singular) +
                              " triangles were flattened: their transforms were inverted with damping");
  }
}

ProgressFn after_preparation(const ProgressFn& progress) {
  if (!progress) return progress;
  return [&progress](Progress p) {
    p.fraction = kPrepared + (1 - kPrepared) * p.fraction;
    return progress(p);
  };
}

}  // namespace

Reshape::Reshape(const PositionsRef& positions, const TrianglesRef& triangles, const ReshapeOptions& options) {
  check(positions, triangles);
  Mesh mesh{positions, triangles};
  check_options(options, mesh);
  Edges edges = edges_of(mesh.triangles);
  check_surface(mesh, edges);
  std::vector<StraightTriple> straight =
      straight_triples(options.straight_chains, edges, static_cast<int>(mesh.positions.rows()));
  const UnitBox box = unit_box(mesh.positions);
  plan_ =
      std::make_unique<ReshapePlan>(ReshapePlan{options, std::move(mesh), box, std::move(edges), std::move(straight)});
  if (!plan_->options.backend) plan_->options.backend = cpu_backend();
}

Reshape::~Reshape() = default;
Reshape::Reshape(Reshape&&) noexcept = default;
Reshape& Reshape::operator=(Reshape&&) noexcept = default;

bool Reshape::prepare(const ProgressFn& progress) {
  ReshapePlan& plan = *plan_;
  if (plan.prepared()) return true;
  auto goes_on = [&](const char* stage, double part) {
    return !progress || progress({stage, 0, plan.options.pass_limit, part * kPrepared, 0});
  };
  const Stopwatch watch(plan.prepare_seconds);
  const Mesh unit_mesh{plan.box.into(plan.mesh.positions), plan.mesh.triangles};
  if (!goes_on("curvature", 0)) return false;
  const Curvatures curvatures = plan.options.unit_box_curvatures
                                    ? *plan.options.unit_box_curvatures
                                    : curvature(unit_mesh.positions, unit_mesh.triangles, {}, *plan.options.backend);
  plan.weights = step_weights(plan.options, unit_mesh);
  plan.rest = rest_shape(plan.options, unit_mesh, plan.edges, curvatures);
  plan.step = plan.options.backend->transform(plan.rest);
  if (!goes_on("order", 0.2)) return false;
  const std::optional<FactorKind> kind = factor_kind(plan.options);
  plan.vertices = vertex_system(plan.rest, plan.straight, kind);
  BlockSystem transforms = transform_system(plan.rest, kind);
  if (!goes_on("factor", 0.4)) return false;
  transforms.factor();
  if (plan.options.solver == ReshapeSolver::steady && !plan.options.refactor_every_pass) transforms.keep_single();
  plan.transforms = std::move(transforms);
  return goes_on("prepared", 1);
}

ReshapeResult Reshape::solve(const Gesture& gesture, const ProgressFn& progress) {
  ReshapePlan& plan = *plan_;
  check(gesture, plan.mesh.positions, plan.mesh.triangles);
  ReshapeResult result;
  result.positions = result.unfinished = plan.mesh.positions;
  result.report.stop = Termination::cancelled;
  if (!prepare(progress)) return result;

  Iterate iterate = start(plan, gesture);
  Positions positions = plan.rest.vertices;
  Alternation steps{[&](Positions& placed) { return place(plan, iterate, placed); },
                    [&](const Positions&) { fit(plan, iterate); }};
  if (plan.options.solver == ReshapeSolver::steady) {
    steps.next = [&](const Positions& from, const Positions& to) { return next_start(plan, iterate, from, to); };
  }
  result.report = alternate(stop_rule(plan), after_preparation(progress), positions, steps);
  result.unfinished = plan.box.back(positions);
  if (plan.options.finalise && result.report.stop != Termination::cancelled) {
    if (const std::optional<Positions> spread = spread_dimples(plan, iterate, positions)) {
      result.finalised = true;
      positions = *spread;
    }
  }
  result.positions = plan.box.back(positions);
  tell(plan, iterate, result.report);
  return result;
}

ReshapeResult reshape(const PositionsRef& positions, const TrianglesRef& triangles, const Gesture& gesture,
                      const ReshapeOptions& options, const ProgressFn& progress) {
  return Reshape(positions, triangles, options).solve(gesture, progress);
}

}  // namespace swage
