// A smooth warp of space that takes the mesh along, ahead of its passes.
#include <algorithm>
#include <utility>

#include "edit_plan.h"

namespace swage {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

constexpr double kFar = 0.05;     // Of D: a warp is asked for no more at a vertex,
constexpr double kNone = 1e-7;    // for smaller gaps there is none,
constexpr double kLeft = 0.5;     // and where it leaves more of their squares it is none of the mesh.
constexpr int kCorrections = 2;   // It is of first order.
constexpr double kWarped = 0.07;  // Part of maps within the surface: there edges alone tell of none.

bool folds(const Transforms& maps) {
  const auto turns_over = [](const auto& map) { return !(Rows(Eigen::Map<const Rows>(map.data())).determinant() > 0); };
  return std::any_of(maps.rowwise().begin(), maps.rowwise().end(), turns_over);
}

/// Once more of the warp, unless that helps little or folds space, where the template asks for what cannot be.
bool step(EditPlan& plan) {
  const Tracking& tracking = plan.tracking;
  const double most = kFar * plan.diagonal, none = kNone * plan.diagonal;
  const VectorXd gaps = tracking.gaps.cwiseMax(-most).cwiseMin(most);
  const double squares = tracking.weights.dot(gaps.cwiseAbs2());
  if (!(squares > tracking.weights.sum() * none * none)) return false;
  find_idle(plan);
  const Positions control = plan.free_form.fit(tracking.directions, gaps, tracking.weights, idle_displacements(plan));
  const Positions moved = plan.free_form.displacements(control);
  const VectorXd left = gaps - moved.cwiseProduct(tracking.directions).rowwise().sum();
  if (!(tracking.weights.dot(left.cwiseAbs2()) < kLeft * squares)) return false;
  Warp& warp = plan.warp;
  Positions in_all = warp.control.rows() > 0 ? Positions(warp.control + control) : control;
  Transforms maps = plan.free_form.maps(in_all);
  if (folds(maps)) return false;
  plan.positions += moved;
  warp = {std::move(in_all), std::move(maps)};
  fit_maps(plan);
  return true;
}

}  // namespace

bool warp(EditPlan& plan, const VectorXd& parameters) {
  if (!step(plan)) return false;
  for (int i = 0; i < kCorrections; ++i) {
    track(plan, parameters);
    if (!step(plan)) break;
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
