#include "alternate.h"
#include "anderson.h"
#include "matrices.h"
#include "plan.h"
#include "warnings.h"

namespace swage {
namespace {

const Mesh& given_mesh(const DeformPlan& plan) { return plan.given ? plan.given->mesh() : plan.mesh; }

std::unique_ptr<DeformSteps> workspace(const DeformPlan& plan) {
  auto work = std::make_unique<DeformSteps>();
  const Backend& backend = *plan.options.backend;
  if (plan.options.method == DeformMethod::conformal) work->similarity = backend.similarity(plan.elements.pairs);
  if (plan.options.method == DeformMethod::arap || plan.options.method == DeformMethod::arap_volume) {
    work->rotation = backend.rotation(plan.elements.pairs);
  }
  return work;
}

void fit_matrices(DeformSteps& work, const Positions& positions, Transforms& matrices) {
  if (work.rotation) work.rotation->fit(positions, {}, matrices);
  if (work.similarity) work.similarity->fit(positions, {}, matrices);
}

StopRule stop_rule(const DeformPlan& plan, bool warm) {
  StopRule stop;
  stop.by_energy = false;
  stop.pass_limit = plan.options.method == DeformMethod::poisson ? 1 : plan.options.pass_limit;
  if (warm) stop.first_test = 1;
  stop.movement = plan.options.movement * plan.mean_edge_length;
  return stop;
}

/// In the unit box, with what joins and fills the mesh.
Positions start_of(const DeformPlan& plan, const DeformResult* from) {
  Positions start = plan.elements.pairs.vertices;
  if (!from) return start;
  const Positions given = plan.box.into(from->positions);
  if (plan.given) {
    start.topRows(plan.mesh.positions.rows()) = given(plan.given->vertices(), Eigen::all);
  } else {
    start.topRows(given.rows()) = given;
  }
  return start;
}

/// Without the backend's.
std::map<std::string, std::size_t> bytes_by_part(const DeformPlan& plan, const HeldLaplacian& held) {
  return {{"elements", bytes(plan.elements.pairs)},
          {"vertex_system", plan.system.bytes() + held.coupling_bytes()},
          {"factor", held.factor_bytes()}};
}

void tell(const DeformPlan& plan, const Gesture& gesture, DeformResult& result) {
  Report& report = result.report;
  report.paths["components"] = plan.told_components;
  if (!plan.told_filling.empty()) report.paths["filling"] = plan.told_filling;
  report.seconds["precompute"] = plan.prepare_seconds;
  if (report.stop == Termination::cancelled) return;
  warn_of_shape({plan.counts, plan.edges, plan.flat_triangles, plan.components}, report);
  warn_of_misses(given_mesh(plan), gesture, result.positions, "handles are held softly; raise their weight", report);
}

/// One solve's state.
struct Iterate {
  const HeldLaplacian& held;
  const HeldPoints& points;
  const std::vector<Hold>& holds;
  DeformSteps& work;
  Transforms matrices;
  Anderson acceleration;
  bool fits = false;  ///< Whether the matrices do the next start.
  std::vector<std::map<std::string, double>> energies = {};
};

std::map<std::string, double> energy(const DeformPlan& plan, const Iterate& iterate, const Positions& positions) {
  return {{"edges", edge_energy(plan.elements.pairs, positions, iterate.matrices)},
          {"handles", hold_energy(plan.options, iterate.holds, positions)}};
}

double sum(const std::map<std::string, double>& energies) { return energies.at("edges") + energies.at("handles"); }

/// A combined start counts where its energy is below the last pass's (Peng et al.: Anderson Acceleration for Geometry
/// Optimization and Physics Simulation, 2018): what buckles is far from linear.
Positions next_start(const DeformPlan& plan, Iterate& iterate, const Positions& start, const Positions& end) {
  Positions next = iterate.acceleration.next(start, end);
  fit_matrices(iterate.work, next, iterate.matrices);
  iterate.fits = true;
  if (sum(energy(plan, iterate, next)) <= sum(iterate.energies.back())) return next;
  iterate.acceleration = Anderson(plan.options.acceleration_window);
  iterate.fits = false;
  return end;
}

Report passes(const DeformPlan& plan, Iterate& iterate, const StopRule& stop, const ProgressFn& progress,
              Positions& positions) {
  Alternation steps;
  steps.place = [&](Positions& placed, const Poll&) {
    placed = iterate.held.solve(plan.system.right_hand_sides(iterate.matrices), iterate.points);
    iterate.fits = false;
    iterate.energies.push_back(energy(plan, iterate, placed));
    return sum(iterate.energies.back());
  };
  if (plan.options.acceleration_window > 0) {
    steps.next = [&](const Positions& start, const Positions& end, const Poll&) {
      return next_start(plan, iterate, start, end);
    };
  }
  steps.fit = [&](const Positions& placed, const Poll&) {
    if (!iterate.fits) fit_matrices(iterate.work, placed, iterate.matrices);
  };
  Report report = alternate(stop, progress, positions, steps);
  if (report.passes > 0) report.energy_by_term = iterate.energies[static_cast<size_t>(report.best_pass)];
  if (plan.options.method == DeformMethod::poisson && report.passes == 1) report.stop = Termination::moved_little;
  return report;
}

DeformResult cancelled(const DeformPlan& plan, const DeformResult* from) {
  DeformResult result{from ? from->positions : given_mesh(plan).positions, {}};
  result.report.stop = Termination::cancelled;
  return result;
}

DeformResult solve_prepared(DeformPlan& plan, const std::vector<Hold>& holds, const DeformResult* from,
                            const ProgressFn& progress) {
  const HeldPoints points = held_points(plan.system, holds, plan.options.handle_weight);
  const std::shared_ptr<const HeldLaplacian> held =
      held_laplacian(plan.last_held, plan.system, points, plan.given, "Deform");
  const auto work = plan.workspaces.lend([&] { return workspace(plan); });
  Positions positions = start_of(plan, from);
  Iterate iterate{
      *held, points, holds, *work, identities(plan.system.element_count()), Anderson(plan.options.acceleration_window)};
  if (from) fit_matrices(*work, positions, iterate.matrices);
  DeformResult result;
  result.report = passes(plan, iterate, stop_rule(plan, from), after_preparation(progress), positions);
  if (result.report.passes == 0) return cancelled(plan, from);
  result.report.bytes = bytes_by_part(plan, *held);
  const Positions solved = plan.box.back(positions.topRows(plan.mesh.positions.rows()));
  result.positions =
      plan.given ? plan.given->back(solved, matrices_of_triangles(plan.elements, plan.mesh.triangles, iterate.matrices))
                 : solved;
  return result;
}

DeformResult solve(DeformPlan& plan, const Gesture& gesture, const DeformResult* from, const ProgressFn& progress) {
  const Mesh& given = given_mesh(plan);
  check(gesture, given.positions, given.triangles);
  if (from) check_start(*from, given);
  if (!prepare(plan, progress)) return cancelled(plan, from);
  std::vector<Hold> holds = holds_of(gesture);
  if (plan.given) holds = plan.given->into(holds);
  double seconds = 0;
  DeformResult result;
  {
    const Stopwatch watch(seconds);
    result = solve_prepared(plan, in_box(holds, plan.box), from, progress);
  }
  if (plan.given) plan.given->place_loose(gesture, result.positions);
  result.report.seconds["solve"] = seconds;
  tell(plan, gesture, result);
  return result;
}

}  // namespace

Deform::Deform(const PositionsRef& positions, const TrianglesRef& triangles, const DeformOptions& options) {
  check(positions, triangles);
  check_options(options);
  plan_ = plan_of({positions, triangles}, options);
}

Deform::~Deform() = default;
Deform::Deform(Deform&&) noexcept = default;
Deform& Deform::operator=(Deform&&) noexcept = default;

bool Deform::prepare(const ProgressFn& progress) { return swage::prepare(*plan_, progress); }

DeformResult Deform::solve(const Gesture& gesture, const ProgressFn& progress) {
  return swage::solve(*plan_, gesture, nullptr, progress);
}

DeformResult Deform::solve(const Gesture& gesture, const DeformResult& start, const ProgressFn& progress) {
  return swage::solve(*plan_, gesture, &start, progress);
}

DeformResult deform(const PositionsRef& positions, const TrianglesRef& triangles, const Gesture& gesture,
                    const DeformOptions& options, const ProgressFn& progress) {
  return Deform(positions, triangles, options).solve(gesture, progress);
}

}  // namespace swage
