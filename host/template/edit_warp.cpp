// A smooth warp of space that takes the mesh along, ahead of its passes.
#include "edit_plan.h"

namespace swage {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

constexpr double kFar = 0.05;        // Of D: a warp is asked for no more at a vertex,
constexpr double kBehind = 0.002;    // Of D: who stays behind the template by that much is asked half,
constexpr double kNone = 1e-7;       // for smaller gaps there is none,
constexpr double kWarpLeaves = 0.5;  // and where it leaves more of their squares it is none of the mesh.
constexpr int kCorrections = 2;      // It is of first order.
constexpr double kWarped = 0.07;     // Part of maps within the surface: there edges alone tell of none.

/// Weights of tracking, less where the mesh stayed behind before: what the template asks for there cannot be, and asked
/// in each sub-edit anew it would fold the warp.
VectorXd weights_of(const EditPlan& plan, const VectorXd& behind) {
  const double half = kBehind * plan.diagonal;
  return plan.tracking.weights.array() / (1 + (behind / half).array().square());
}

bool step(EditPlan& plan, const VectorXd& behind) {
  const Tracking& tracking = plan.tracking;
  const double most = kFar * plan.diagonal, none = kNone * plan.diagonal;
  const VectorXd gaps = tracking.gaps.cwiseMax(-most).cwiseMin(most);
  const VectorXd weights = weights_of(plan, behind);
  const double squares = weights.dot(gaps.cwiseAbs2());
  if (!(squares > weights.sum() * none * none)) return false;
  find_idle(plan);
  const Positions control = plan.free_form.fit(tracking.directions, gaps, weights, idle_displacements(plan));
  const Positions moved = plan.free_form.displacements(control);
  const VectorXd left = gaps - moved.cwiseProduct(tracking.directions).rowwise().sum();
  if (!(weights.dot(left.cwiseAbs2()) < kWarpLeaves * squares)) return false;
  plan.positions += moved;
  Warp& warp = plan.warp;
  warp.control = warp.control.rows() > 0 ? Positions(warp.control + control) : control;
  warp.maps = plan.free_form.maps(warp.control);
  fit_maps(plan);
  return true;
}

}  // namespace

bool warp(EditPlan& plan, const VectorXd& parameters, const VectorXd& behind) {
  if (!step(plan, behind)) return false;
  for (int i = 0; i < kCorrections; ++i) {
    track(plan, parameters);
    if (!step(plan, behind)) break;
  }
  return true;
}

void lean_on_warp(EditPlan& plan) {
#pragma omp parallel for schedule(static)
  for (Index v = 0; v < plan.warp.maps.rows(); ++v) {
    const Eigen::RowVector3d normal = plan.rest_normals.row(v);
    Eigen::Map<Rows> map(plan.maps.row(v).data());
    const Rows off = Eigen::Map<const Rows>(plan.warp.maps.row(v).data()) - map;
    map += kWarped * (off - off * normal.transpose() * normal);
  }
}

}  // namespace swage
