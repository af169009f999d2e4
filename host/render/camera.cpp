#include "camera.h"

#include <Eigen/Geometry>
#include <string>

#include "swage/error.h"

namespace swage {
namespace {

/// The axis that is most across.
Eigen::Vector3d axis_across(const Eigen::Vector3d& direction) {
  Eigen::Index axis;
  direction.cwiseAbs().minCoeff(&axis);
  return Eigen::Vector3d::Unit(axis);
}

}  // namespace

Camera::Camera(const View& view, const char* function) {
  const double length = view.from.stableNorm();
  if (!view.from.allFinite() || !view.up.allFinite() || !(length > 0)) {
    throw InvalidInput(std::string(function) +
                       ": the view's direction is zero or not finite, or its up is not finite; give directions");
  }
  toward = (view.from / length).normalized();
  const Eigen::Vector3d wanted = view.up.stableNormalized();
  right = wanted.cross(toward);
  if (right.norm() < 1e-6) right = axis_across(toward).cross(toward);
  right.normalize();
  up = toward.cross(right);
}

}  // namespace swage
