// Preconditioned conjugate gradients.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace swage {

struct Gradients {
  int iterations = 0;
  bool converged = false;
};

/// Improves `solution` of matrix · solution = right_hand_side until the error, in the norm that the preconditioner
/// stands for, is `tolerance` times what it was, for `limit` iterations, or until those so far
/// tell that twice the limit would not do. `precondition` turns a residual into about
/// the error that leaves it, in place.
Gradients conjugate_gradients(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& times_matrix,
                              const std::function<void(Eigen::VectorXd&)>& precondition,
                              const Eigen::VectorXd& right_hand_side, double tolerance, int limit,
                              Eigen::VectorXd& solution);

}  // namespace swage
