// Passes.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "anderson.h"
#include "cancel.h"
#include "edit_plan.h"

namespace swage {
namespace {

using Eigen::Index;
using Eigen::RowVector3d;
using Eigen::VectorXd;

constexpr double kStep = 0.02;           // Of D: no vertex goes farther for the template in a pass.
constexpr double kJump = 0.01;           // Of D: a sub-edit moves the template no farther,
constexpr double kLeastPart = 1.0 / 64;  // but this part of the way it goes at least.
constexpr int kSubEditPasses = 2;
constexpr int kWholeMoves = 5;    // Of a pass.
constexpr double kBegin = 0.02;   // Of a sub-edit.
constexpr double kSolved = 1e-4;  // Part of the error that ends conjugate gradients.
constexpr int kWindow = 3;        // Passes that the next start is made of.
constexpr int kPatience = 50;     // Passes until triangles that turned over are looked at,
constexpr int kReleases = 16;     // and how often they are released.
constexpr double kAway = 5;       // Steps that they go together at least, unless they go to and fro,
constexpr int kParts = 256;       // and are then as many parts of what passes ask for, at most.

Eigen::Map<const Positions> rows(const VectorXd& flat) { return {flat.data(), flat.size() / 3, 3}; }
Eigen::Map<Positions> rows(VectorXd& flat) { return {flat.data(), flat.size() / 3, 3}; }

/// product = laplacian · x + m a (a . x)
void times_matrix(const EditPlan& plan, const VectorXd& x, VectorXd& product) {
  product.resize(x.size());
  const SparseMatrix& laplacian = plan.system.laplacian();
  const auto from = rows(x);
  auto to = rows(product);
#pragma omp parallel for schedule(static)
  for (Index v = 0; v < laplacian.cols(); ++v) {
    const RowVector3d a = plan.tracking.directions.row(v);
    RowVector3d sum = plan.tracking.weights[v] * a.dot(from.row(v)) * a;
    for (SparseMatrix::InnerIterator entry(laplacian, v); entry; ++entry) sum += entry.value() * from.row(entry.row());
    to.row(v) = sum;
  }
}

/// What is left of both terms' right-hand sides where the mesh is.
VectorXd residual(const EditPlan& plan) {
  VectorXd result(plan.positions.size());
  auto to = rows(result);
  to = plan.system.right_hand_sides(plan.maps);
  const SparseMatrix& laplacian = plan.system.laplacian();
  const Tracking& tracking = plan.tracking;
  const double most = kStep * plan.diagonal;
#pragma omp parallel for schedule(static)
  for (Index v = 0; v < laplacian.cols(); ++v) {
    RowVector3d sum = tracking.weights[v] * std::clamp(tracking.gaps[v], -most, most) * tracking.directions.row(v);
    for (SparseMatrix::InnerIterator entry(laplacian, v); entry; ++entry) {
      sum -= entry.value() * plan.positions.row(entry.row());
    }
    to.row(v) += sum;
  }
  return result;
}

/// How far the template moves from where it is to the parameters, over the mesh, in the unit box.
double jump_to(EditPlan& plan, const VectorXd& parameters, FieldValues& field) {
  evaluate(plan, plan.positions, parameters, FieldDerivatives::none, field);
  const Eigen::ArrayXd slopes = plan.tracking.field.gradients.rowwise().norm().array().max(1e-3);
  Eigen::ArrayXd moved = (field.values - plan.tracking.field.values).array().abs() / slopes;
  const auto most = moved.begin() + (99 * moved.size()) / 100;
  std::nth_element(moved.begin(), most, moved.end());
  return *most;
}

/// By what tracking holds.
void place(EditPlan& plan, int iterations, double part) {
  fit_maps(plan);
  const VectorXd right = residual(plan);
  VectorXd moved = VectorXd::Zero(right.size());
  const auto times = [&](const VectorXd& x, VectorXd& y) { times_matrix(plan, x, y); };
  const auto precondition = [&](const VectorXd& r, VectorXd& e) {
    e.resize(r.size());
    rows(e) = plan.about->solve(rows(r), plan.about_points);
  };
  conjugate_gradients(times, precondition, right, kSolved, iterations, moved, plan.work);
  Positions displacements = rows(moved);
  stay(plan, displacements);
  plan.positions += part * displacements;
}

/// Goes with a sub-edit as its begin has it: past that, what moves by half of its thickness would be told of its other
/// side.
void foresee(EditPlan& plan, const VectorXd& from, const VectorXd& to) {
  track(plan, from);
  const VectorXd behind = plan.tracking.gaps;
  track(plan, from + kBegin * (to - from));
  plan.tracking.gaps = behind + (plan.tracking.gaps - behind) / kBegin;
  if (!warp(plan, to, behind) && !move_as_whole(plan)) place(plan, kSettling, 1);
}

/// What a mesh that does not come to stand still was at best: where fewest triangles had turned over and, of such, the
/// template was nearest.
struct Best {
  size_t over = 0;
  double off = 0;  ///< Mean gap.
  Positions positions = {};
  Transforms maps = {};
  VectorXd trust = {};

  void look(const EditPlan& plan, size_t over_now) {
    const double off_now = plan.tracking.gaps.cwiseAbs().mean();
    if (positions.rows() > 0 && std::pair(over, off) <= std::pair(over_now, off_now)) return;
    *this = {over_now, off_now, plan.positions, plan.maps, plan.trust};
  }
};

/// Passes at the target, by `one`, until the mesh stands still with no triangle turned over, or there are enough. Where
/// it comes no closer it goes to and fro across a crease of the field, whose slope leaps there: steps grow smaller.
template <typename One>
void settle(EditPlan& plan, Report& report, const One& one) {
  std::optional<Anderson> acceleration(kWindow);
  Best best;
  Positions start, before;  // Of the last pass, and of as many as are waited for.
  int parts = 1, releases = 0, since = 0;
  const auto tell = [&] {
    report.paths["steps"] = parts == 1 ? "whole" : "1/" + std::to_string(parts) + " in the end";
  };
  tell();
  while (report.passes < plan.options.passes) {
    if (since > 0) plan.positions = acceleration->next(start, plan.positions);
    if (since % kPatience == 0) before = plan.positions;
    start = plan.positions;
    const Positions gradients = plan.tracking.gradients;
    one(1.0 / parts);
    ++since;
    distrust_opposed(plan, gradients);
    const double moved = report.movements.back();
    const bool stands = moved < plan.options.tolerance * plan.diagonal;
    if (!stands && since % kPatience != 0) continue;
    const std::vector<int> over = folded(plan);
    best.look(plan, over.size());
    if (stands && (over.empty() || releases == kReleases)) {
      report.stop = Termination::moved_little;
      return;
    }
    if (!over.empty() && releases < kReleases) {
      distrust(plan, over, releases++ / 3);
      parts = 1;
    } else if (parts < kParts && (plan.positions - before).rowwise().norm().maxCoeff() < kAway * moved * parts) {
      parts *= 2;
    } else {
      continue;
    }
    tell();
    since = 0;
    acceleration.emplace(kWindow);
  }
  best.look(plan, folded(plan).size());
  plan.positions = best.positions;
  plan.maps = best.maps;
  plan.trust = best.trust;
}

}  // namespace

void fit_maps(EditPlan& plan) {
  if (plan.rotation) {
    plan.rotation->fit(plan.positions, {}, plan.maps);
  } else {
    plan.local_map->fit(plan.positions, vertex_normals(plan.positions, plan.mesh.triangles), plan.maps);
  }
  if (!plan.rotation) lean_on_warp(plan);
  aim(plan);
}

double pass(EditPlan& plan, const VectorXd& parameters, int iterations, double part) {
  const Positions before = plan.positions;
  track(plan, parameters);
  for (int i = 0; i < kWholeMoves && move_as_whole(plan); ++i) track(plan, parameters);
  plan.parameters = parameters;
  place(plan, iterations, part);
  return (plan.positions - before).rowwise().norm().maxCoeff();
}

Report advance(EditPlan& plan, const VectorXd& target, const ProgressFn& progress) {
  Report report;
  const VectorXd source = plan.parameters;
  const auto along = [&](double part) -> VectorXd { return part >= 1 ? target : source + part * (target - source); };
  const auto tell = [&] {
    const double done = static_cast<double>(report.passes) / plan.options.passes;
    if (progress && !progress({"pass", report.passes, plan.options.passes, done, 0})) throw Cancelled();
  };
  const auto one = [&](double part, double step) {
    tell();
    report.movements.push_back(pass(plan, along(part), kSettling, step));
    ++report.passes;
  };
  FieldValues field;
  double at = 0;
  int sub_edits = 0;
  try {
    if (follow_as_whole(plan, target, tell)) {
      report.stop = Termination::moved_little;
      report.paths["sub_edits"] = "none: moved, turned and scaled as a whole";
      return report;
    }
    while (at < 1 && report.passes < plan.options.passes) {
      double part = plan.options.sub_edits > 0 ? 1.0 / plan.options.sub_edits : 1 - at;
      if (plan.options.sub_edits == 0) {
        if (sub_edits == 0) track(plan, source);
        while (part > kLeastPart && jump_to(plan, along(at + part), field) > kJump * plan.diagonal) part /= 2;
      }
      const double next = at + part > 1 - 1e-9 ? 1 : at + part;
      foresee(plan, along(at), along(next));
      at = next;
      ++sub_edits;
      for (int i = 0; i < kSubEditPasses && report.passes < plan.options.passes; ++i) one(at, 1);
    }
    settle(plan, report, [&](double step) { one(1, step); });
    report.paths["flips"] = heal(plan);
  } catch (const Cancelled&) {
    report.stop = Termination::cancelled;
  }
  report.paths["sub_edits"] = std::to_string(sub_edits);
  return report;
}

TemplateEditResult result_of(EditPlan& plan, const VectorXd& target, Report report) {
  TemplateEditResult result;
  track(plan, target);
  const Index count = plan.unsplit.vertices;
  const Eigen::ArrayXd off = plan.tracking.gaps.head(count).array().abs() / plan.diagonal;
  result.residual = off.mean();
  result.largest = off.maxCoeff();
  result.flipped = static_cast<int>(flipped(plan, plan.unsplit.triangles, plan.unsplit.is_flat).size());
  result.released = static_cast<int>((plan.trust.head(count).array() < 1).count());
  const Positions placed = plan.box.back(plan.positions.topRows(count));
  result.positions = plan.pose.back(
      plan.given ? plan.given->back(placed, matrices_of_triangles(plan.elements, plan.unsplit.triangles, plan.maps))
                 : placed);
  result.report = std::move(report);
  return result;
}

}  // namespace swage
