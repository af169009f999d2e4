#include "conjugate_gradients.h"

#include <cmath>

namespace swage {
namespace {

/// Whether `limit` iterations would not do, going by those so far.
bool hopeless(int iterations, int limit, double part, double part_enough) {
  constexpr int kTelling = 4;
  return iterations >= kTelling && iterations * std::log(part_enough) / std::log(part) > 2 * limit;
}

}  // namespace

Gradients conjugate_gradients(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& times_matrix,
                              const std::function<void(Eigen::VectorXd&)>& precondition,
                              const Eigen::VectorXd& right_hand_side, double tolerance, int limit,
                              Eigen::VectorXd& solution) {
  Gradients result;
  Eigen::VectorXd residual = right_hand_side - times_matrix(solution), error = residual;
  precondition(error);
  Eigen::VectorXd direction = error;
  double square = residual.dot(error);
  const double first = square, enough = tolerance * tolerance;
  while (true) {
    // A residual of nothing is solved; so is one that rounding left without a direction.
    result.converged = !(square > enough * first);
    if (result.converged || result.iterations == limit) return result;
    if (hopeless(result.iterations, limit, square / first, enough)) return result;
    const Eigen::VectorXd image = times_matrix(direction);
    const double step = square / direction.dot(image);
    solution += step * direction;
    // Polak, Ribière: a preconditioner in single precision is not quite the same from one iteration to the next.
    const Eigen::VectorXd residual_before = residual;
    residual -= step * image;
    error = residual;
    precondition(error);
    const double before = square;
    square = residual.dot(error);
    direction = error + (square - residual_before.dot(error)) / before * direction;
    ++result.iterations;
  }
}

}  // namespace swage
