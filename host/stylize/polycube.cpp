#include "swage/polycube.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "alternate.h"
#include "element_normals.h"
#include "messages.h"
#include "place_and_size.h"
#include "plan.h"
#include "targets.h"
#include "thin_triangles.h"
#include "warnings.h"

namespace swage {
namespace {

// Local and global steps of a pass: the first, which leads far, and the others.
constexpr int kFirstSteps = 60, kSteps = 5;

void check_options(const PolycubeOptions& options) {
  const auto refuse_unless = [](bool fits, const char* option, double value, const char* range) {
    if (!fits)
      throw InvalidInput(std::string("polycube: options.") + option + ": " + digits(value) + " is not " + range);
  };
  refuse_unless(options.lambda > 0 && std::isfinite(options.lambda), "lambda", options.lambda, "finite and above 0");
  refuse_unless(options.pass_limit >= 1, "pass_limit", options.pass_limit, "at least 1");
  refuse_unless(options.energy_drop >= 0 && std::isfinite(options.energy_drop), "energy_drop", options.energy_drop,
                "finite and at least 0");
  refuse_unless(options.least_angle >= 0 && options.least_angle <= std::numbers::pi / 6, "least_angle",
                options.least_angle, "in [0, pi/6]");
}

StylizeOptions stylize_options(const PolycubeOptions& options) {
  StylizeOptions own;
  own.energy = StylizeEnergy::farap;
  own.weights = StylizeWeights::clamped;
  own.pass_limit = options.pass_limit;
  own.backend = options.backend;
  return own;
}

/// One call's state.
class Boxes {
 public:
  Boxes(StylizePlan& plan, const Style& style, const PolycubeOptions& options, const Gesture& handles)
      : plan_(plan),
        options_(options),
        handles_(handles),
        targets_(targets_of(plan, style)),
        is_held_(held_components(plan, handles)),
        at_rest_(places_and_sizes(plan, plan.elements.pairs.vertices)),
        is_fixed_(plan.component.size(), 0),
        rest_normals_(plan.elements.pairs.normals) {
    for (const int v : points_held(plan, handles).fixed) {
      const int component = plan.component[static_cast<size_t>(v)];
      is_fixed_[static_cast<size_t>(v)] = is_held_[static_cast<size_t>(component)];
    }
  }

  /// A pass: some steps of a stylization, from the rest shape. Gives the energy.
  double place(Positions& positions, const Poll& poll) {
    const bool first = terms.empty();
    const Positions start = positions;
    stylize(positions, first ? kFirstSteps : kSteps, poll);
    if (!first) {
      restore(plan_, at_rest_, is_held_, positions);  // What is held back goes back to where it started.
      hold_back(plan_, is_fixed_, options_.least_angle, rest_normals_, start, positions);
      relax(plan_, is_fixed_, targets_.find(positions), positions);
    }
    restore(plan_, at_rest_, is_held_, positions);
    return off_targets(positions);
  }

  /// Of the mesh as given.
  GivenNormals targets(const Positions& positions) const { return as_given(plan_, targets_.find(positions)); }

  std::vector<StylizeTerms> terms;

 private:
  void stylize(Positions& positions, int count, const Poll& poll) {
    LastHeld none;  // What is held is the same as in the pass before, but not the system.
    LastHeld& last = terms.empty() ? plan_.last_held : none;
    const HeldPoints points = points_held(plan_, handles_);
    const auto held = held_laplacian(last, plan_.system, points, plan_.given, "polycube");
    const std::unique_ptr<StylizeSteps> steps = steps_of(plan_);
    StylizeFit fitted = unmoved(plan_.system.element_count());
    Positions target_normals;
    for (int i = 0; i < count; ++i) {
      ask(poll);
      target_normals = targets_.find(positions);
      fit(plan_, *steps, positions, target_normals, options_.lambda, fitted);
      positions = held->solve(plan_.system.right_hand_sides(fitted.matrices), points);
    }
    const double square = plan_.box.extent * plan_.box.extent;
    const StylizeTerms end = energy(plan_, positions, target_normals, fitted);
    terms.push_back({end.shape * square, end.normals * square});
  }

  double off_targets(const Positions& positions) const {
    const Eigen::VectorXd areas = area_vectors(positions, plan_.mesh.triangles).rowwise().norm();
    const Positions off = element_normals(plan_, positions) - targets_.find(positions);
    return areas.dot(off.rowwise().squaredNorm()) / areas.sum();
  }

  StylizePlan& plan_;
  const PolycubeOptions& options_;
  const Gesture& handles_;
  Targets targets_;
  std::vector<char> is_held_;  // Components.
  std::vector<PlaceAndSize> at_rest_;
  std::vector<char> is_fixed_;  // Vertices that are handles.
  Positions rest_normals_;
};

/// How the rest shape's triangles turned.
Transforms turned(StylizePlan& plan, const Positions& rest, const Positions& positions) {
  renew(plan, rest);
  StylizeFit fitted = unmoved(plan.system.element_count());
  fit(plan, *steps_of(plan), positions, plan.elements.pairs.normals, 0, fitted);
  return fitted.matrices;
}

StylizeResult solve(StylizePlan& plan, const ClosestNormals& closest, const PolycubeOptions& options,
                    const Gesture& handles, const ProgressFn& progress) {
  const Style style = closest;
  const Positions rest = plan.elements.pairs.vertices;
  Boxes boxes(plan, style, options, handles);
  StopRule stop;
  stop.pass_limit = options.pass_limit;
  stop.first_test = 2;
  stop.energy_drop = options.energy_drop;
  Alternation passes;
  passes.place = [&](Positions& placed, const Poll& poll) { return boxes.place(placed, poll); };
  passes.fit = [&](const Positions& placed, const Poll&) { renew(plan, placed); };
  StylizeResult result;
  Positions positions = rest;
  result.report = alternate(stop, after_preparation(progress), positions, passes);
  result.passes = std::move(boxes.terms);
  result.first_targets = boxes.targets(rest);
  result.last_targets = boxes.targets(positions);
  result.positions = plan.box.back(positions);
  if (plan.given) {
    result.positions = plan.given->back(result.positions, turned(plan, rest, positions));
    plan.given->place_loose(handles, result.positions);
  }
  return result;
}

}  // namespace

StylizeResult polycube(const PositionsRef& positions, const TrianglesRef& triangles, const ClosestNormals& style,
                       const PolycubeOptions& options, const Gesture& handles, const ProgressFn& progress) {
  check(positions, triangles);
  check_options(options);
  check_closest("polycube", style);
  if (!handles.targets.empty()) check(handles, positions, triangles);
  const std::unique_ptr<StylizePlan> plan = plan_of({positions, triangles}, stylize_options(options), "polycube");
  StylizeResult result;
  result.positions = positions;
  result.report.stop = Termination::cancelled;
  if (!prepare(*plan, progress)) return result;
  double seconds = 0;
  {
    const Stopwatch watch(seconds);
    result = solve(*plan, style, options, handles, progress);
  }
  if (result.report.passes == 0) result.positions = positions;
  result.report.seconds = {{"precompute", plan->prepare_seconds}, {"solve", seconds}};
  warn_of_shape({plan->counts, plan->edges, plan->flat_triangles, 1}, result.report);
  return result;
}

}  // namespace swage
