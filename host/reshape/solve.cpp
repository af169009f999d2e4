#include "alternate.h"
#include "anderson.h"
#include "coarse.h"
#include "plan.h"

namespace swage {
namespace {

constexpr int kPlainPasses = 2;  // Far from the fixed point, and unlike those after: nothing to learn from.

Holds handles_of(const Gesture& gesture, const UnitBox& box, double weight) {
  Holds handles{{}, Positions(static_cast<Eigen::Index>(gesture.targets.size()), 3), weight};
  for (const auto& [vertex, target] : gesture.targets) {
    handles.targets.row(static_cast<Eigen::Index>(handles.vertices.size())) =
        (target.transpose() - box.corner) / box.extent;
    handles.vertices.push_back(vertex);
  }
  return handles;
}

/// Where passes start, in the unit box.
struct Start {
  Positions positions;
  Transforms transforms;
  bool warm = false;  ///< Whether another result's.
};

Start start_of(const ReshapePlan& plan, const ReshapeResult* result) {
  if (!result) return {plan.box.into(plan.mesh.positions), identities(plan.mesh.triangles.rows())};
  return {plan.box.into(result->unfinished), result->transforms, true};
}

/// Whatever the workspace was used for before, it starts as new.
Iterate begin(const ReshapePlan& plan, Workspace& work, const Gesture& gesture, const Start& start) {
  Iterate iterate{work};
  iterate.acceleration = Anderson(plan.options.acceleration_window);
  iterate.handles = handles_of(gesture, plan.box, plan.weights.handle);
  iterate.transforms = start.transforms;
  work.step->reset();
  work.vertices.forget();
  if (work.vertices.system.has_factor() != plan.vertices->system.has_factor())
    work.vertices = plan.vertices->unsolved();
  work.vertices.sphericity = plan.vertices->sphericity;
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
  positions = place_vertices(iterate.work.vertices, *plan.rest, iterate.quadratics, plan.straight,
                             plan.weights.straightness, {iterate.handles}, iterate.before, poll);
  ask(poll);
  const TransformStep::Energy local = iterate.work.step->fit_transforms(positions, iterate.right_hand_sides);
  iterate.energy_by_term.push_back(energy_terms(local, positions, plan.straight, plan.weights, iterate.handles));
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

ProgressFn after_preparation(const ProgressFn& progress) {
  if (!progress) return progress;
  return [&progress](Progress p) {
    p.fraction = kPrepared + (1 - kPrepared) * p.fraction;
    return progress(p);
  };
}

void finish(const ReshapePlan& plan, Iterate& iterate, const ProgressFn& progress, Positions& positions,
            ReshapeResult& result) {
  const Report& report = result.report;
  const Stopwatch watch(iterate.seconds["finish"]);
  const Progress now{"finish", report.passes, plan.options.pass_limit, 1, report.energy};
  try {
    const Poll poll = sparing([&] { return !progress || progress(now); });
    if (const std::optional<Positions> spread = spread_dimples(plan, iterate, positions, poll)) {
      result.finalised = true;
      positions = *spread;
    }
  } catch (const Cancelled&) {
    result.report.stop = Termination::cancelled;
  }
}

ReshapeResult solve(ReshapePlan& changing, const Gesture& gesture, const ReshapeResult* from,
                    const ProgressFn& progress) {
  const ReshapePlan& plan = changing;
  Start start = start_of(plan, from);
  ReshapeResult result;
  result.positions = result.unfinished = from ? from->unfinished : plan.mesh.positions;
  result.transforms = start.transforms;
  result.report.stop = Termination::cancelled;
  if (!prepare(changing, progress)) return result;

  const ProgressFn solving = after_preparation(progress);
  double coarse_seconds = 0;
  if (plan.coarse && !from) {
    const Stopwatch watch(coarse_seconds);
    std::optional<Transforms> coarse = coarse_transforms(*plan.coarse, plan, gesture, solving);
    if (!coarse) return result;
    start.transforms = std::move(*coarse);
  }
  const auto work = plan.workspaces.lend([&] { return workspace(plan); });
  Iterate iterate = begin(plan, *work, gesture, start);
  if (plan.coarse) iterate.seconds["coarse_start"] = coarse_seconds;
  Positions positions = std::move(start.positions);
  Alternation steps{[&](Positions& placed, const Poll& poll) { return place(plan, iterate, placed, poll); },
                    [&](const Positions&, const Poll& poll) { fit(plan, iterate, poll); }};
  if (plan.options.solver == ReshapeSolver::steady) {
    steps.next = [&](const Positions& before, const Positions& end, const Poll& poll) {
      return next_start(iterate, before, end, poll);
    };
  }
  result.report = alternate(stop_rule(plan, start.warm), solving, positions, steps);
  result.unfinished = plan.box.back(positions);
  if (plan.options.finalise && result.report.stop != Termination::cancelled) {
    finish(plan, iterate, solving, positions, result);
  }
  result.positions = plan.box.back(positions);
  result.transforms = std::move(iterate.transforms);
  tell(plan, iterate, start.warm, result.report);
  return result;
}

/// The published solver is never another, whatever rounds in another order.
std::optional<Renumbered> renumbered(const ReshapeOptions& options, const Mesh& mesh, const Edges& edges) {
  constexpr Eigen::Index kWorthwhile = 1'000;  // Vertices. All of fewer are in the cache.
  if (options.solver == ReshapeSolver::published || mesh.positions.rows() < kWorthwhile) return std::nullopt;
  return Renumbered(mesh, edges);
}

/// What `call` returns; where it throws for an element, that as the caller numbers it.
template <typename Call>
auto in_given_numbers(const ReshapePlan& plan, const Call& call) {
  try {
    return call();
  } catch (const Indefinite& error) {
    if (!plan.renumbered) throw;
    const bool vertex = error.unknowns() == plan.mesh.positions.size();
    throw Indefinite(error.unknowns(),
                     vertex ? plan.renumbered->vertex(error.element()) : plan.renumbered->triangle(error.element()));
  }
}

ReshapeResult solve_as_given(ReshapePlan& plan, const Gesture& gesture, const ReshapeResult* start,
                             const ProgressFn& progress) {
  const Mesh& given = plan.renumbered ? plan.renumbered->given() : plan.mesh;
  check(gesture, given.positions, given.triangles);
  if (start) check_start(*start, plan.options, given);
  return in_given_numbers(plan, [&] {
    if (!plan.renumbered) return solve(plan, gesture, start, progress);
    std::optional<ReshapeResult> from;
    if (start) from = plan.renumbered->into(*start);
    return plan.renumbered->back(solve(plan, plan.renumbered->into(gesture), start ? &*from : nullptr, progress));
  });
}

}  // namespace

Reshape::Reshape(const PositionsRef& positions, const TrianglesRef& triangles, const ReshapeOptions& options) {
  check(positions, triangles);
  Mesh mesh{positions, triangles};
  check_options(options, mesh);
  Edges edges = edges_of(mesh.triangles);
  check_surface(mesh, edges);
  const auto vertex_count = static_cast<int>(mesh.positions.rows());
  std::vector<StraightTriple> straight = straight_triples(options.straight_chains, edges, vertex_count);
  const UnitBox box = unit_box(mesh.positions);
  std::optional<Renumbered> other = renumbered(options, mesh, edges);
  ReshapeOptions own = options;
  if (other) {
    mesh = other->mesh();
    own = other->into(std::move(own));
    edges = edges_of(mesh.triangles);
    straight = straight_triples(own.straight_chains, edges, vertex_count);
  }
  if (!own.backend) own.backend = cpu_backend();
  plan_.reset(
      new ReshapePlan{std::move(own), std::move(other), std::move(mesh), box, std::move(edges), std::move(straight)});
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
