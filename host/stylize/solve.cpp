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

/// One call's state.
class Passes {
 public:
  Passes(StylizePlan& plan, const Style& style, double lambda, const Gesture& handles)
      : plan_(plan),
        lambda_(lambda),
        points_(points_held(plan, handles)),
        held_(held_laplacian(plan.last_held, plan.system, points_, plan.given, "Stylize")),
        steps_(plan.workspaces.lend([&] { return steps_of(plan); })),
        targets_(targets_of(plan, style)),
        target_normals_(targets_.find(plan.elements.pairs.vertices)),
        fitted_(unmoved(plan.system.element_count())),
        acceleration_(plan.options.acceleration_window) {
    if (steps_->similarity) keep_size_.emplace(plan, points_);
    fit_now(plan.elements.pairs.vertices);
  }

  /// The global step. Gives the energy.
  double place(Positions& positions) {
    positions = held_->solve(plan_.system.right_hand_sides(fitted_.matrices), points_);
    fits_ = false;
    terms.push_back(terms_at(positions));
    return sum(terms.back());
  }

  /// From where the next pass starts: from where several passes lead, if the energy is not higher there.
  Positions next(const Positions& start, const Positions& end) {
    Positions next = acceleration_.next(start, end);
    if (next == end) return next;
    const StylizeFit before = fitted_;
    fit_to(next);
    if (sum(terms_at(next)) <= sum(terms.back())) return next;
    acceleration_ = Anderson(plan_.options.acceleration_window);
    fitted_ = before;
    fits_ = false;
    return end;
  }

  /// The local step, unless next() has done it.
  void fit(const Positions& positions) {
    if (!fits_) fit_to(positions);
  }

  GivenNormals targets() const { return as_given(plan_, target_normals_); }
  const Transforms& matrices() const { return fitted_.matrices; }
  const HeldLaplacian& held() const { return *held_; }

  std::vector<StylizeTerms> terms;

 private:
  void fit_to(const Positions& positions) {
    if (targets_.dynamic) target_normals_ = targets_.find(positions);
    fit_now(positions);
  }

  void fit_now(const Positions& positions) {
    swage::fit(plan_, *steps_, positions, target_normals_, lambda_, fitted_);
    if (keep_size_) keep_size_->of(plan_, fitted_);
    fits_ = true;
  }

  StylizeTerms terms_at(const Positions& positions) const {
    const double square = plan_.box.extent * plan_.box.extent;
    const StylizeTerms unit = energy(plan_, positions, target_normals_, fitted_);
    return {unit.shape * square, unit.normals * square};
  }

  double sum(const StylizeTerms& of) const { return of.shape + lambda_ * of.normals; }

  StylizePlan& plan_;
  double lambda_;
  HeldPoints points_;
  std::shared_ptr<const HeldLaplacian> held_;
  Pool<StylizeSteps>::Lease steps_;
  Targets targets_;
  Positions target_normals_;
  StylizeFit fitted_;
  std::optional<KeepSize> keep_size_;
  Anderson acceleration_;
  bool fits_ = false;  // Whether the matrices are of the next start.
};

StylizeResult solve_prepared(StylizePlan& plan, const Style& style, double lambda, const Gesture& handles,
                             const ProgressFn& progress) {
  Passes passes(plan, style, lambda, handles);
  StylizeResult result;
  result.first_targets = passes.targets();
  Alternation alternation;
  alternation.place = [&](Positions& placed, const Poll&) { return passes.place(placed); };
  alternation.fit = [&](const Positions& placed, const Poll&) { passes.fit(placed); };
  alternation.moved_little = [&](const Positions& start, const Positions& end) {
    return moved_little(plan, start, end);
  };
  if (plan.options.acceleration_window > 0) {
    alternation.next = [&](const Positions& start, const Positions& end, const Poll&) {
      return passes.next(start, end);
    };
  }
  Positions positions = plan.elements.pairs.vertices;
  result.report = alternate(stop_rule(plan), after_preparation(progress), positions, alternation);

  if (result.report.passes == 0) return cancelled(plan);
  result.last_targets = passes.targets();
  result.passes = std::move(passes.terms);
  const StylizeTerms& last = result.passes.back();
  result.report.energy_by_term = {{"shape", last.shape}, {"normals", lambda * last.normals}};
  const Positions solved = plan.box.back(positions);
  result.positions = plan.given ? plan.given->back(solved, of_triangles(plan, passes.matrices())) : solved;
  if (plan.given) plan.given->place_loose(handles, result.positions);
  tell(plan, passes.held(), result.report);
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
