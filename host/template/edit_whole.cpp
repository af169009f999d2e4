// What the template does as a whole, the mesh does at once: passes alone would carry it across slowly.
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>

#include "edit_plan.h"

namespace swage {
namespace {

using Eigen::Index;
using Eigen::RowVector3d;
using Eigen::Vector3d;

/// Of displacements t + w × x + s x: t, w, s.
using Motion = Eigen::Vector<double, 7>;
using Motions = Eigen::Matrix<double, 7, 7>;
using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

constexpr double kMotionLeaves = 0.25;  // A motion that leaves more of the squared gaps is none of the whole.
constexpr double kNoGap = 1e-7;         // Of D: smaller gaps are none.
constexpr double kUntold = 0.3;         // Of the mean gap: what a motion of the whole may leave along the way.
constexpr int kSteps = 16;              // Of a motion of the whole,
constexpr int kMoves = 3;               // and how often each is corrected,
constexpr int kLastMoves = 12;          // and the last.
constexpr double kIdle = 1e-4;  // Part of a motion's squares that is along tracking's directions: below, it is idle.

/// By which the tracking rows are met best, about the middle; what it leaves of the squared gaps; and motions, each of
/// length 1 in the rows' weights, that no row is told of.
struct Whole {
  Motion motion = Motion::Zero();
  IdleMotions idle;
  RowVector3d middle = RowVector3d::Zero();
  double square = 0, left = 0;
};

/// Of a displacement at x its product with those of each of the motions there.
Motion along(const Vector3d& x, const Vector3d& moved) {
  Motion row;
  row << moved, x.cross(moved), x.dot(moved);
  return row;
}

RowVector3d displacement(const Motion& motion, const Vector3d& at) {
  const Vector3d slide = motion.head<3>(), turn = motion.segment<3>(3);
  return (slide + turn.cross(at) + motion[6] * at).transpose();
}

/// `grows`: what lies off the surface scales along.
Whole best_motion(const EditPlan& plan, bool grows) {
  const Tracking& tracking = plan.tracking;
  const double mass = tracking.weights.sum();
  Whole whole;
  if (!(mass > 0)) return whole;
  whole.middle = tracking.weights.transpose() * plan.positions / mass;
  Motions told = Motions::Zero();
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  Motion right = Motion::Zero();
  for (Index v = 0; v < plan.positions.rows(); ++v) {
    const double weight = tracking.weights[v], gap = tracking.gaps[v];
    if (!(weight > 0)) continue;
    const Vector3d at = plan.positions.row(v) - whole.middle;
    Motion row = along(at, tracking.directions.row(v));
    if (grows) row[6] -= plan.growth * plan.rest_values[v] / tracking.field.gradients.row(v).norm();
    told += weight * row * row.transpose();
    spread += weight * at * at.transpose();
    right += weight * gap * row;
    whole.square += weight * gap * gap;
  }
  Motions all = Motions::Zero();  // The motions' own products, summed by weight.
  all.topLeftCorner<3, 3>().diagonal().setConstant(mass);
  all.block<3, 3>(3, 3) = spread.trace() * Eigen::Matrix3d::Identity() - spread;
  all(6, 6) = spread.trace();
  all.diagonal().array() += 1e-9 * all.trace();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Motions> modes(told, all);
  const auto idle = (modes.eigenvalues().array() < kIdle).count();
  whole.idle = modes.eigenvectors().leftCols(idle);
  for (Index k = idle; k < modes.eigenvalues().size(); ++k) {
    const Motion mode = modes.eigenvectors().col(k);
    whole.motion += mode.dot(right) / modes.eigenvalues()[k] * mode;
  }
  whole.left = whole.square - right.dot(whole.motion);
  return whole;
}

/// Keeps what is idle.
Whole whole_motion(EditPlan& plan) {
  Whole whole = best_motion(plan, false);
  plan.idle = whole.idle;
  plan.idle_about = whole.middle;
  return whole;
}

void move(EditPlan& plan, const Whole& whole) {
  const Vector3d turn = whole.motion.segment<3>(3);
  const double angle = turn.norm();
  const Eigen::Matrix3d rotation =
      angle > 0 ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() : Eigen::Matrix3d::Identity();
  const Positions about = plan.positions.rowwise() - whole.middle;
  plan.positions = (std::exp(whole.motion[6]) * about * rotation.transpose()).rowwise() +
                   (whole.middle + whole.motion.head<3>().transpose());
  for (Index v = 0; v < plan.maps.rows(); ++v) {
    Eigen::Map<Rows> map(plan.maps.row(v).data());
    map = (rotation * map).eval();
  }
}

/// Root mean square of the gaps.
double mean_gap(const EditPlan& plan) {
  const Eigen::VectorXd& weights = plan.tracking.weights;
  const double mass = weights.sum();
  return mass > 0 ? std::sqrt(weights.dot(plan.tracking.gaps.cwiseAbs2()) / mass) : 0;
}

}  // namespace

bool move_as_whole(EditPlan& plan) {
  const Whole whole = whole_motion(plan);
  const double still = kNoGap * plan.diagonal;
  if (!(whole.square > plan.tracking.weights.sum() * still * still)) return false;
  if (!(whole.left < kMotionLeaves * whole.square)) return false;
  move(plan, whole);
  return true;
}

void find_idle(EditPlan& plan) { whole_motion(plan); }

std::vector<Positions> idle_displacements(const EditPlan& plan) {
  std::vector<Positions> result(static_cast<size_t>(plan.idle.cols()), Positions(plan.positions.rows(), 3));
  const double root = std::sqrt(plan.tracking.weights.sum());
  for (Index v = 0; v < plan.positions.rows(); ++v) {
    const Vector3d at = plan.positions.row(v) - plan.idle_about;
    for (Index k = 0; k < plan.idle.cols(); ++k) {
      result[static_cast<size_t>(k)].row(v) = root * displacement(plan.idle.col(k), at);
    }
  }
  return result;
}

void stay(const EditPlan& plan, Positions& moved) {
  if (plan.idle.cols() == 0) return;
  Motion sum = Motion::Zero();
  for (Index v = 0; v < moved.rows(); ++v) {
    sum += plan.tracking.weights[v] * along(plan.positions.row(v) - plan.idle_about, moved.row(v));
  }
  const Motion drift = plan.idle * (plan.idle.transpose() * sum);
  for (Index v = 0; v < moved.rows(); ++v) {
    moved.row(v) -= displacement(drift, plan.positions.row(v) - plan.idle_about);
  }
}

bool follow_as_whole(EditPlan& plan, const Eigen::VectorXd& target, const Poll& poll) {
  const Eigen::VectorXd source = plan.parameters;
  const Positions positions = plan.positions;
  const Transforms maps = plan.maps;
  const double growth = plan.growth;
  const auto explained = [&] {
    for (int step = 1; step <= kSteps; ++step) {
      ask(poll);
      const double part = static_cast<double>(step) / kSteps;
      const Eigen::VectorXd parameters = source + part * (target - source);
      track(plan, parameters);
      const double before = mean_gap(plan);
      for (int i = 0; i < (step == kSteps ? kLastMoves : kMoves); ++i) {
        const Whole whole = best_motion(plan, true);
        move(plan, whole);
        plan.growth *= std::exp(whole.motion[6]);
        track(plan, parameters);
      }
      if (!(mean_gap(plan) <= std::max(kUntold * before, kNoGap * plan.diagonal))) return false;
    }
    return mean_gap(plan) <= kNoGap * plan.diagonal;
  };
  if (explained()) {
    plan.parameters = target;
    return true;
  }
  plan.positions = positions;
  plan.maps = maps;
  plan.growth = growth;
  return false;
}

}  // namespace swage
