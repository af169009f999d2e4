// Preconditioned conjugate gradients.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace swage {

struct Gradients {
  int iterations = 0;
  bool converged = false;
};

/// Whether `limit` iterations would not do, going by those so far, which left `part` of the error's square.
inline bool hopeless(int iterations, int limit, double part, double part_enough) {
  constexpr int kTelling = 4;
  return iterations >= kTelling && iterations * std::log(part_enough) / std::log(part) > 2 * limit;
}

/// Improves `solution` of matrix · solution = right_hand_side until the error, in the norm that the preconditioner
/// stands for, is `tolerance` times what it was, for `limit` iterations, or until those so far tell that twice the
/// limit would not do, or that rounding made the matrix or the preconditioner indefinite. `times_matrix(x, y)` makes y
/// the product; `precondition(r, e)` makes e about the error that leaves the residual r. In single precision or in
/// double.
template <typename Vector, typename TimesMatrix, typename Precondition>
Gradients conjugate_gradients(const TimesMatrix& times_matrix, const Precondition& precondition,
                              const Vector& right_hand_side, double tolerance, int limit, Vector& solution) {
  using Scalar = typename Vector::Scalar;
  const auto product = [](const Vector& a, const Vector& b) {
    return a.template cast<double>().dot(b.template cast<double>());
  };
  Gradients result;
  Vector image, error;
  times_matrix(solution, image);
  Vector residual = right_hand_side - image;
  result.converged = residual.isZero(0);
  if (result.converged) return result;
  precondition(residual, error);
  Vector direction = error;
  double square = product(residual, error);
  const double first = square, enough = tolerance * tolerance;
  while (square > 0) {
    result.converged = square <= enough * first;
    if (result.converged || result.iterations == limit) break;
    if (hopeless(result.iterations, limit, square / first, enough)) break;
    times_matrix(direction, image);
    const double bend = product(direction, image);
    if (!(bend > 0)) break;
    const double step = square / bend;
    solution += static_cast<Scalar>(step) * direction;
    residual -= static_cast<Scalar>(step) * image;
    precondition(residual, error);
    // Polak, Ribière: a preconditioner need not be quite the same from one iteration to the next.
    const double turn = -step * product(image, error) / square;
    direction = error + static_cast<Scalar>(turn) * direction;
    square = product(residual, error);
    ++result.iterations;
  }
  return result;
}

}  // namespace swage
