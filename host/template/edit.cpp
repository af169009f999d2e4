// A mesh that follows its template.
#include <algorithm>
#include <iomanip>
#include <sstream>
#include <utility>

#include "edit_plan.h"
#include "preparation.h"
#include "stopwatch.h"
#include "swage/error.h"
#include "warnings.h"

namespace swage {
namespace {

constexpr double kManyReleased = 0.1;  // Part of the vertices.

TemplateEditResult cancelled(const EditPlan& plan) {
  TemplateEditResult result;
  result.positions =
      plan.pose.back(plan.given ? plan.given->mesh().positions : plan.mesh.positions.topRows(plan.unsplit.vertices));
  result.report.stop = Termination::cancelled;
  return result;
}

/// The same with what any edit's report tells.
TemplateEditResult told(const EditPlan& plan, double seconds, TemplateEditResult result) {
  Report& report = result.report;
  report.paths["components"] = plan.told_components;
  report.paths["edges"] = plan.told_edges;
  report.seconds["precompute"] = plan.prepare_seconds;
  report.seconds["solve"] = seconds;
  if (report.stop != Termination::cancelled) {
    const auto flat = static_cast<int>(std::count(plan.unsplit.is_flat.begin(), plan.unsplit.is_flat.end(), 1));
    warn_of_shape({plan.counts, plan.unsplit.edges, flat, plan.components}, report);
  }
  return result;
}

void warn_of_end(const EditPlan& plan, TemplateEditResult& result) {
  Report& report = result.report;
  std::ostringstream text;
  text << std::setprecision(2);
  if (report.stop == Termination::pass_limit) {
    text << "the limit of " << plan.options.passes << " passes was reached before the mesh stood still: the last one "
         << "moved a vertex by " << 100 * report.movements.back() / plan.diagonal << " % of the box diagonal";
    report.warnings.push_back(text.str());
  }
  if (result.flipped > 0) {
    report.warnings.push_back(std::to_string(result.flipped) +
                              " triangles turned over: the mesh cannot do there what the template asks for");
  }
  if (result.released > kManyReleased * static_cast<double>(plan.unsplit.vertices)) {
    report.warnings.push_back(std::to_string(result.released) + " of " + std::to_string(plan.unsplit.vertices) +
                              " vertices go with their neighbours rather than with the template, which asks for what "
                              "they cannot do: look at the result");
  }
}

/// From where the last call left the mesh.
TemplateEditResult advanced(EditPlan& plan, const Eigen::VectorXd& target, const ProgressFn& progress) {
  double seconds = 0;
  TemplateEditResult result;
  {
    const Stopwatch watch(seconds);
    result = result_of(plan, target, advance(plan, target, progress));
  }
  warn_of_end(plan, result);
  return told(plan, seconds, std::move(result));
}

}  // namespace

TemplateEdit::TemplateEdit(const Template& of, const Eigen::VectorXd& source, const TemplatePose& pose,
                           const PositionsRef& positions, const TrianglesRef& triangles,
                           const TemplateEditOptions& options) {
  check(positions, triangles);
  check_options(options);
  check_parameters(of, source, "source");
  plan_ = plan_of(of, source, pose, positions, triangles, options);
}

TemplateEdit::~TemplateEdit() = default;
TemplateEdit::TemplateEdit(TemplateEdit&&) noexcept = default;
TemplateEdit& TemplateEdit::operator=(TemplateEdit&&) noexcept = default;

bool TemplateEdit::prepare(const ProgressFn& progress) { return swage::prepare(*plan_, progress); }

TemplateEditResult TemplateEdit::solve(const Eigen::VectorXd& target, const ProgressFn& progress) {
  check_parameters(plan_->of, target, "target");
  if (!prepare(progress)) return cancelled(*plan_);
  reset(*plan_);
  return advanced(*plan_, target, after_preparation(progress));
}

TemplateEditResult TemplateEdit::follow(const Eigen::VectorXd& target, int passes) {
  check_parameters(plan_->of, target, "target");
  if (passes < 1) throw InvalidInput("TemplateEdit::follow: passes: " + std::to_string(passes) + " is below 1");
  prepare();
  double seconds = 0;
  TemplateEditResult result;
  {
    const Stopwatch watch(seconds);
    Report report;
    plan_->warp = {};  // There is no time for it.
    for (int i = 0; i < passes; ++i) report.movements.push_back(pass(*plan_, target, kDragging));
    report.passes = passes;
    if (report.movements.back() < plan_->options.tolerance * plan_->diagonal) report.stop = Termination::moved_little;
    result = result_of(*plan_, target, std::move(report));
  }
  return told(*plan_, seconds, std::move(result));
}

std::vector<TemplateEditResult> interpolate(TemplateEdit& edit, const Eigen::VectorXd& source,
                                            const Eigen::VectorXd& target, int count, const ProgressFn& progress) {
  EditPlan& plan = *edit.plan_;
  check_parameters(plan.of, source, "source");
  check_parameters(plan.of, target, "target");
  if (count < 2) throw InvalidInput("interpolate: count: " + std::to_string(count) + " is below 2");
  std::vector<TemplateEditResult> steps;
  if (!edit.prepare(progress)) return steps;
  reset(plan);
  for (int i = 0; i < count; ++i) {
    const double part = static_cast<double>(i) / (count - 1);
    const ProgressFn own = [&](Progress p) {
      p.fraction = kPrepared + (1 - kPrepared) * (i + p.fraction) / count;
      return !progress || progress(p);
    };
    TemplateEditResult step = advanced(plan, source + part * (target - source), own);
    if (step.report.stop == Termination::cancelled) break;
    steps.push_back(std::move(step));
  }
  return steps;
}

}  // namespace swage
