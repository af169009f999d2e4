// A transform's inverse, damped where the transform is nearly singular.
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace swage {

struct DampedInverse {
  Eigen::Matrix3d matrix;
  bool damped;
};

/// Where the volume factor is below this part of the largest stretch cubed, the inverse would be noise.
inline constexpr double kSingular = 1e-9;

inline DampedInverse damped_inverse(const Eigen::Matrix3d& transform) {
  const double stretch = std::max(transform.norm(), 1e-100);
  const Eigen::Matrix3d relative = transform / stretch;
  if (std::abs(relative.determinant()) > kSingular) return {relative.inverse() / stretch, false};
  // Least squares with a damping of 1e-3 of the stretch: bounded, and close to the inverse where there is one.
  const Eigen::Matrix3d damped = relative.transpose() * relative + 1e-6 * Eigen::Matrix3d::Identity();
  return {damped.inverse() * relative.transpose() / stretch, true};
}

}  // namespace swage
