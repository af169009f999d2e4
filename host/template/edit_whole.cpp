// What the template does as a whole, the mesh does at once: passes alone would carry it across slowly.
#include <Eigen/Cholesky>
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
using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

constexpr double kLeft = 0.25;     // A motion that leaves more of the squared gaps is none of the whole.
constexpr double kStill = 1e-7;    // Of D: smaller gaps are none.
constexpr double kDamping = 1e-9;  // A ball may turn in place.

}  // namespace

bool move_as_whole(EditPlan& plan) {
  const Tracking& tracking = plan.tracking;
  const double mass = tracking.weights.sum();
  if (!(mass > 0)) return false;
  const RowVector3d middle = tracking.weights.transpose() * plan.positions / mass;
  Eigen::Matrix<double, 7, 7> matrix = Eigen::Matrix<double, 7, 7>::Zero();
  Motion right = Motion::Zero();
  double square = 0;
  for (Index v = 0; v < plan.positions.rows(); ++v) {
    const Vector3d at = plan.positions.row(v) - middle, direction = tracking.directions.row(v);
    Motion row;
    row << direction, at.cross(direction), direction.dot(at);
    const double weight = tracking.weights[v], gap = tracking.gaps[v];
    matrix += weight * row * row.transpose();
    right += weight * gap * row;
    square += weight * gap * gap;
  }
  const double still = kStill * plan.diagonal;
  if (!(square > mass * still * still)) return false;
  matrix.diagonal().array() += kDamping * matrix.trace();
  const Motion motion = matrix.ldlt().solve(right);
  if (!(square - right.dot(motion) < kLeft * square)) return false;
  const Vector3d turn = motion.segment<3>(3);
  const double angle = turn.norm();
  const Eigen::Matrix3d rotation =
      angle > 0 ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() : Eigen::Matrix3d::Identity();
  const Positions about = plan.positions.rowwise() - middle;
  plan.positions =
      (std::exp(motion[6]) * about * rotation.transpose()).rowwise() + (middle + motion.head<3>().transpose());
  for (Index v = 0; v < plan.maps.rows(); ++v) {
    Eigen::Map<Rows> map(plan.maps.row(v).data());
    map = (rotation * map).eval();
  }
  return true;
}

}  // namespace swage
