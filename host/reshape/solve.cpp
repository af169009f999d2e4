#include "alternate.h"
#include "anderson.h"
#include "as_given.h"
#include "coarse.h"
#include "plan.h"
#include "stand_in.h"

namespace swage {
namespace {

constexpr int kPlainPasses = 2;  // Far from the fixed point, and unlike those after: nothing to learn from.

/// Where passes start, in the unit box.
struct Start {
  Positions positions;
  Transforms transforms;
  bool warm = false;  ///< Whether another result's.
};

Start start_of(const ReshapePlan& plan, const ReshapeResult* result) {
  if (!result) return {plan.rest->vertices, identities(plan.mesh.triangles.rows())};
  Start start{plan.rest->vertices, result->transforms, true};
  start.positions.topRows(result->unfinished.rows()) = plan.box.into(result->unfinished);
  return start;
}

/// Those of the mesh, without a scaffold's.
Positions mesh_positions(const ReshapePlan& plan, const Positions& solved) {
  return plan.box.back(solved.topRows(plan.mesh.positions.rows()));
}

/// Whatever the workspace was used for before, it starts as new.
Iterate begin(const ReshapePlan& plan, Workspace& work, const std::vector<Hold>& holds, const Start& start) {
  Iterate iterate{work};
  iterate.acceleration = Anderson(plan.options.acceleration_window);
  iterate.handles = {in_box(holds, plan.box), plan.weights.handle};
  iterate.transforms = start.transforms;
  work.step->reset();
  work.vertices.forget();
  if (work.vertices.system.has_factor() != plan.vertices->system.has_factor())
    work.vertices = plan.vertices->unsolved();
  work.vertices.constant = plan.vertices->constant;
  return iterate;
}

StopRule stop_rule(const ReshapePlan& plan, bool warm) {
  StopRule stop;
  stop.pass_limit = plan.options.pass_limit;
  if (plan.options.solver == ReshapeSolver::steady) {
    stop.by_energy = false;
    if (warm) stop.first_test = 1;
    stop.movement = plan.options.movement * plan.rest->mean_edge_length;
    return stop;
  }
  stop.movement = plan.rest->mean_edge_length / 100;
  stop.energy_drop = 0.01 / static_cast<double>(plan.edges.vertices.rows());
  return stop;
}

double place(const ReshapePlan& plan, Iterate& iterate, Positions& positions, const Poll& poll) {
  const Stopwatch watch(iterate.seconds["vertex_step"]);
  iterate.work.step->fit_edges(iterate.transforms, iterate.quadratics);
  ask(poll);
  iterate.singular = std::max(iterate.singular, iterate.quadratics.singular);
  iterate.before = positions;
  // The published passes solve exactly.
  if (plan.options.solver == ReshapeSolver::published) iterate.work.vertices.system.forget_factor();
  positions = place_vertices(iterate.work.vertices, *plan.rest, iterate.quadratics, plan.bonds, {iterate.handles},
                             iterate.before, poll);
  ask(poll);
  const TransformStep::Energy local = iterate.work.step->fit_transforms(positions, iterate.right_hand_sides);
  iterate.energy_by_term.push_back(energy_terms(local, positions, plan.bonds, plan.weights, iterate.handles));
  return sum(iterate.energy_by_term.back());
}

/// The right-hand sides are those of the positions last placed; of a start combined from several they are made anew.
Positions next_start(Iterate& iterate, const Positions& start, const Positions& end, const Poll& poll) {
  const Stopwatch watch(iterate.seconds["acceleration"]);
  if (iterate.energy_by_term.size() < kPlainPasses) return end;
  Positions next = iterate.acceleration.next(start, end);
  ask(poll);
  iterate.work.step->fit_transforms(next, iterate.right_hand_sides);
  return next;
}

void fit(const ReshapePlan& plan, Iterate& iterate, const Poll& poll) {
  const Stopwatch watch(iterate.seconds["transform_step"]);
  ask(poll);
  if (plan.multilevel) {
    iterate.transforms = improved_transforms(*plan.multilevel, *iterate.work.coupling, iterate.right_hand_sides,
                                             iterate.transforms, poll);
    return;
  }
  std::optional<BlockSystem>& own = iterate.work.transforms;
  if (own) own->factor();
  const BlockSystem& system = own ? *own : *plan.transforms;
  iterate.transforms = system.single() ? improved_transforms(system, iterate.right_hand_sides, iterate.transforms)
                                       : solve_transforms(system, iterate.right_hand_sides);
}

Report passes(const ReshapePlan& plan, Iterate& iterate, const StopRule& stop, const ProgressFn& progress,
              Positions& positions) {
  Alternation steps{[&](Positions& placed, const Poll& poll) { return place(plan, iterate, placed, poll); },
                    [&](const Positions&, const Poll& poll) { fit(plan, iterate, poll); }};
  if (plan.options.solver == ReshapeSolver::steady) {
    steps.next = [&](const Positions& before, const Positions& end, const Poll& poll) {
      return next_start(iterate, before, end, poll);
    };
  }
  return alternate(stop, progress, positions, steps);
}

void finish(const ReshapePlan& plan, Iterate& iterate, const ProgressFn& progress, Positions& positions,
            ReshapeResult& result) {
  const Report& report = result.report;
  const Stopwatch watch(iterate.seconds["finish"]);
  const Progress now{"finish", report.passes, plan.options.pass_limit, 1, report.energy};
  const std::function<bool()> asked = [&] { return !progress || progress(now); };
  const GoOn go_on = [&](Positions& from) {
    iterate.acceleration = Anderson(plan.options.acceleration_window);
    const Report more = passes(
        plan, iterate, stop_rule(plan, true), [&](const Progress&) { return asked(); }, from);
    return more.stop != Termination::cancelled;
  };
  const std::vector<std::map<std::string, double>> energies = iterate.energy_by_term;
  const Holds handles = iterate.handles;
  try {
    std::string told;
    if (const std::optional<Positions> better = finished(plan, iterate, positions, go_on, sparing(asked), told)) {
      result.finalised = true;
      positions = *better;
    }
    if (!told.empty()) result.report.paths["finish"] = told;
  } catch (const Cancelled&) {
    result.report.stop = Termination::cancelled;
  }
  iterate.energy_by_term = energies;
  iterate.handles = handles;
}

ReshapeResult unchanged(const ReshapePlan& plan, const ReshapeResult* from) {
  ReshapeResult result;
  result.positions = result.unfinished = from ? from->unfinished : plan.mesh.positions;
  result.transforms = from ? from->transforms : identities(plan.mesh.triangles.rows());
  result.report.stop = Termination::cancelled;
  return result;
}

ReshapeResult solve(ReshapePlan& changing, const std::vector<Hold>& holds, const ReshapeResult* from,
                    const ProgressFn& progress) {
  const ReshapePlan& plan = changing;
  ReshapeResult result = unchanged(plan, from);
  Start start = start_of(plan, from);
  const ProgressFn solving = after_preparation(progress);
  double coarse_seconds = 0;
  if (plan.coarse && !from) {
    const Stopwatch watch(coarse_seconds);
    std::optional<Transforms> coarse = coarse_transforms(*plan.coarse, plan, holds, solving);
    if (!coarse) return result;
    start.transforms = std::move(*coarse);
  }
  const auto work = plan.workspaces.lend([&] { return workspace(plan); });
  Iterate iterate = begin(plan, *work, holds, start);
  if (plan.coarse) iterate.seconds["coarse_start"] = coarse_seconds;
  Positions positions = std::move(start.positions);
  result.report = passes(plan, iterate, stop_rule(plan, start.warm), solving, positions);
  result.unfinished = mesh_positions(plan, positions);
  result.transforms = iterate.transforms;
  if (plan.options.finalise && result.report.stop != Termination::cancelled) {
    finish(plan, iterate, solving, positions, result);
  }
  result.positions = mesh_positions(plan, positions);
  result.straight_chains = static_cast<int>(plan.options.straight_chains.size());
  if (plan.scaffold.rows() > 0) result.scaffold = ReshapedScaffold{plan.box.back(positions), plan.scaffold};
  tell(plan, iterate, start.warm, result.report);
  return result;
}

ReshapeResult timed_solve(ReshapePlan& plan, const std::vector<Hold>& holds, const ReshapeResult* from,
                          const ProgressFn& progress) {
  double seconds = 0;
  ReshapeResult result;
  {
    const Stopwatch watch(seconds);
    result = solve(plan, holds, from, progress);
  }
  result.report.seconds["solve"] = seconds;
  return result;
}

/// What `call` returns; where it throws for an element, that as the caller numbers it.
template <typename Call>
auto in_given_numbers(const ReshapePlan& plan, const Call& call) {
  try {
    return call();
  } catch (const Indefinite& error) {
    if (!plan.given) throw;
    const bool is_vertex = plan.rest && error.unknowns() == plan.rest->vertices.size();
    if (plan.stand_in || !plan.rest) throw;
    if (is_vertex && error.element() >= plan.mesh.positions.rows()) throw;  // A scaffold's.
    throw Indefinite(error.unknowns(),
                     is_vertex ? plan.given->vertex(error.element()) : plan.given->triangle(error.element()));
  }
}

const Mesh& given_mesh(const ReshapePlan& plan) { return plan.given ? plan.given->mesh() : plan.mesh; }

ReshapeResult cancelled(const ReshapePlan& plan, const ReshapeResult* start) {
  ReshapeResult result;
  result.positions = result.unfinished = start ? start->unfinished : given_mesh(plan).positions;
  result.transforms = start ? start->transforms : identities(given_mesh(plan).triangles.rows());
  result.report.stop = Termination::cancelled;
  return result;
}

ReshapeResult solve_as_given(ReshapePlan& plan, const Gesture& gesture, const ReshapeResult* start,
                             const ProgressFn& progress) {
  const Mesh& given = given_mesh(plan);
  check(gesture, given.positions, given.triangles);
  if (start) check_start(*start, plan.options, given);
  ReshapeResult result = solve_holds(plan, holds_of(gesture), start, progress);
  if (plan.given) {
    plan.given->place_loose(gesture, result.positions);
    plan.given->place_loose(gesture, result.unfinished);
  }
  if (result.report.stop != Termination::cancelled) warn(plan, gesture, result);
  return result;
}

}  // namespace

ReshapeResult solve_holds(ReshapePlan& plan, const std::vector<Hold>& holds, const ReshapeResult* start,
                          const ProgressFn& progress) {
  const std::vector<Hold> solved = plan.given ? plan.given->into(holds) : holds;
  return in_given_numbers(plan, [&] {
    if (!prepare(plan, progress)) return cancelled(plan, start);
    if (plan.stand_in) return solve_stand_in(plan, given_mesh(plan), holds, start, progress);
    if (!plan.given) return timed_solve(plan, solved, start, progress);
    std::optional<ReshapeResult> from;
    if (start) from = into(*plan.given, *start);
    return back(*plan.given, timed_solve(plan, solved, start ? &*from : nullptr, progress));
  });
}

Reshape::Reshape(const PositionsRef& positions, const TrianglesRef& triangles, const ReshapeOptions& options) {
  check(positions, triangles);
  Mesh mesh{positions, triangles};
  check_options(options, mesh);
  check_chains(options.straight_chains, mesh);
  plan_ = plan_of(std::move(mesh), options);
}

Reshape::~Reshape() = default;
Reshape::Reshape(Reshape&&) noexcept = default;
Reshape& Reshape::operator=(Reshape&&) noexcept = default;

bool Reshape::prepare(const ProgressFn& progress) {
  return in_given_numbers(*plan_, [&] { return swage::prepare(*plan_, progress); });
}

ReshapeResult Reshape::solve(const Gesture& gesture, const ProgressFn& progress) {
  return solve_as_given(*plan_, gesture, nullptr, progress);
}

ReshapeResult Reshape::solve(const Gesture& gesture, const ReshapeResult& start, const ProgressFn& progress) {
  return solve_as_given(*plan_, gesture, &start, progress);
}

ReshapeResult reshape(const PositionsRef& positions, const TrianglesRef& triangles, const Gesture& gesture,
                      const ReshapeOptions& options, const ProgressFn& progress) {
  return Reshape(positions, triangles, options).solve(gesture, progress);
}

}  // namespace swage
