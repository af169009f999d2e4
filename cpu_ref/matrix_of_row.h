// A row of Transforms as the matrix it is.
#pragma once

#include "swage/steps.h"

namespace swage {

inline Eigen::Matrix3d matrix(const Transforms& transforms, Eigen::Index triangle) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(transforms.row(triangle).data());
}

}  // namespace swage
