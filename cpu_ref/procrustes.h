// What the references of rotation and similarity share.
#pragma once

#include "swage/steps.h"

namespace swage {

inline Eigen::Index element_count(const PairsRest& rest) {
  return rest.offsets.empty() ? 0 : static_cast<Eigen::Index>(rest.offsets.size()) - 1;
}

/// sum_p w_p b_p a_pᵀ
Eigen::Matrix3d edge_covariance(const PairsRest& rest, const Positions& positions, Eigen::Index element);
/// w_n t nᵀ, or 0
Eigen::Matrix3d normal_covariance(const PairsRest& rest, const Positions& targets, Eigen::Index element);
/// The rotation R that maximises tr Rᵀ covariance.
Eigen::Matrix3d closest_rotation(const Eigen::Matrix3d& covariance);

inline void store(const Eigen::Matrix3d& matrix, Transforms& rows, Eigen::Index row) {
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows.row(row).data()) = matrix;
}

}  // namespace swage
