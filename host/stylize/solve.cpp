#include <algorithm>
#include <utility>

#include "alternate.h"
#include "anderson.h"
#include "keep_size.h"
#include "plan.h"
#include "targets.h"
#include "warnings.h"

namespace swage {
namespace {

const Mesh& given_mesh(const StylizePlan& plan) { return plan.given ? plan.given->mesh() : plan.mesh; }

Transforms of_triangles(const StylizePlan& plan, const Transforms& matrices) {
  if (plan.of_triangles()) return matrices;
  return matrices_of_triangles(plan.elements, plan.mesh.triangles, matrices);
}

/// max|U - U_prev| / max|U - V|, and whether nothing moves but by rounding.
bool moved_little(const StylizePlan& plan, const Positions& start, const Positions& end) {
  constexpr double kRounding = 1e-13;  // Of the unit box.
  const double moved = (end - start).cwiseAbs().maxCoeff();
  const double in_all = (end - plan.elements.pairs.vertices).cwiseAbs().maxCoeff();
  return moved < plan.options.movement * in_all || moved <= kRounding;
}

StopRule stop_rule(const StylizePlan& plan) {
  StopRule stop;
  stop.by_energy = false;
  stop.pass_limit = plan.options.pass_limit;
  return stop;
}

void tell(const StylizePlan& plan, const HeldLaplacian& held, Report& report) {
  report.seconds["precompute"] = plan.prepare_seconds;
  report.bytes = {{"elements", bytes(plan.elements.pairs)},
                  {"vertex_system", plan.system.bytes() + held.coupling_bytes()},
                  {"factor", held.factor_bytes()}};
  if (report.stop == Termination::cancelled) return;
  warn_of_shape({plan.counts, plan.edges, plan.flat_triangles, 1}, report);
  if (plan.anchors.size() > 1) {
    report.warnings.push_back(
        std::to_string(plan.anchors.size()) +
        " components that no triangle joins: those without a handle keep their place by a vertex");
  }
}

StylizeResult cancelled(const StylizePlan& plan) {
  StylizeResult result;
  result.positions = given_mesh(plan).positions;
  result.report.stop = Termination::cancelled;
  return result;
}

StylizeResult solve_prepared(StylizePlan& plan, const Style& style, double lambda, const Gesture& handles,
                             const ProgressFn& progress) {
  const HeldPoints points = points_held(plan, handles);
  const std::shared_ptr<const HeldLaplacian> held =
      held_laplacian(plan.last_held, plan.system, points, plan.given, "Stylize");
  const auto steps = plan.workspaces.lend([&] { return steps_of(plan); });
  const Targets targets = targets_of(plan, style);

  StylizeResult result;
  Positions positions = plan.elements.pairs.vertices;
  Positions target_normals = targets.find(positions);
  result.first_targets = as_given(plan, target_normals);
  StylizeFit fitted = unmoved(plan.system.element_count());
  std::optional<KeepSize> keep_size;
  if (steps->similarity) keep_size.emplace(plan, points);
  bool fits = false;  // Whether matrices are of the next start.
  const auto fit_to = [&](const Positions& placed) {
    fit(plan, *steps, placed, target_normals, lambda, fitted);
    if (keep_size) keep_size->of(plan, fitted);
    fits = true;
  };
  fit_to(positions);
  const auto terms_at = [&](const Positions& placed) {
    StylizeTerms terms = energy(plan, placed, target_normals, fitted);
    terms.shape *= plan.box.extent * plan.box.extent;
    terms.normals *= plan.box.extent * plan.box.extent;
    return terms;
  };
  const auto sum = [&](const StylizeTerms& terms) { return terms.shape + lambda * terms.normals; };
  Anderson acceleration(plan.options.acceleration_window);

  Alternation passes;
  passes.place = [&](Positions& placed, const Poll&) {
    placed = held->solve(plan.system.right_hand_sides(fitted.matrices), points);
    fits = false;
    result.passes.push_back(terms_at(placed));
    return sum(result.passes.back());
  };
  passes.moved_little = [&](const Positions& start, const Positions& end) { return moved_little(plan, start, end); };
  if (plan.options.acceleration_window > 0) {
    // As Deform's.
    passes.next = [&](const Positions& start, const Positions& end, const Poll&) {
      Positions next = acceleration.next(start, end);
      if (next == end) return next;
      const StylizeFit before = fitted;
      if (targets.dynamic) target_normals = targets.find(next);
      fit_to(next);
      if (sum(terms_at(next)) <= sum(result.passes.back())) return next;
      acceleration = Anderson(plan.options.acceleration_window);
      fitted = before;
      fits = false;
      return end;
    };
  }
  passes.fit = [&](const Positions& placed, const Poll&) {
    if (fits) return;
    if (targets.dynamic) target_normals = targets.find(placed);
    fit_to(placed);
  };
  result.report = alternate(stop_rule(plan), after_preparation(progress), positions, passes);

  if (result.report.passes == 0) return cancelled(plan);
  result.last_targets = as_given(plan, target_normals);
  const StylizeTerms& last = result.passes.back();
  result.report.energy_by_term = {{"shape", last.shape}, {"normals", lambda * last.normals}};
  const Positions solved = plan.box.back(positions);
  result.positions = plan.given ? plan.given->back(solved, of_triangles(plan, fitted.matrices)) : solved;
  if (plan.given) plan.given->place_loose(handles, result.positions);
  tell(plan, *held, result.report);
  return result;
}

}  // namespace

Stylize::Stylize(const PositionsRef& positions, const TrianglesRef& triangles, const StylizeOptions& options) {
  check(positions, triangles);
  check_options(options);
  plan_ = plan_of({positions, triangles}, options);
}

Stylize::~Stylize() = default;
Stylize::Stylize(Stylize&&) noexcept = default;
Stylize& Stylize::operator=(Stylize&&) noexcept = default;

bool Stylize::prepare(const ProgressFn& progress) { return swage::prepare(*plan_, progress); }

StylizeResult Stylize::solve(const Style& style, double lambda, const Gesture& handles, const ProgressFn& progress) {
  const Mesh& given = given_mesh(*plan_);
  check_style(*plan_, style, lambda);
  if (!handles.targets.empty()) check(handles, given.positions, given.triangles);
  if (!prepare(progress)) return cancelled(*plan_);
  double seconds = 0;
  StylizeResult result;
  {
    const Stopwatch watch(seconds);
    result = solve_prepared(*plan_, style, lambda, handles, progress);
  }
  result.report.seconds["solve"] = seconds;
  return result;
}

StylizeResult stylize(const PositionsRef& positions, const TrianglesRef& triangles, const Style& style, double lambda,
                      const StylizeOptions& options, const Gesture& handles, const ProgressFn& progress) {
  return Stylize(positions, triangles, options).solve(style, lambda, handles, progress);
}

}  // namespace swage
