// Preconditioned conjugate gradients.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "gradients.h"
#include "vectors.h"

namespace swage {

/// Whether `limit` iterations would not do, going by those so far, which left `part` of the error's square.
inline bool hopeless(int iterations, int limit, double part, double part_enough) {
  constexpr int kTelling = 4;
  return iterations >= kTelling && iterations * std::log(part_enough) / std::log(part) > 2 * limit;
}

/// What conjugate gradients write, to be used again for systems of the same size.
template <typename Vector>
struct GradientsWork {
  Vector image, error, residual, direction;
};

/// Improves `solution` of matrix · solution = right_hand_side until the error, in the norm that the preconditioner
/// stands for, is `tolerance` times what it was, for `limit` iterations, or until those so far tell that twice the
/// limit would not do, or that rounding made the matrix or the preconditioner indefinite. `times_matrix(x, y)` makes y
/// the product; `precondition(r, e)` makes e about the error that leaves the residual r. In single precision or in
/// double.
template <typename Vector, typename TimesMatrix, typename Precondition>
Gradients conjugate_gradients(const TimesMatrix& times_matrix, const Precondition& precondition,
                              const Vector& right_hand_side, double tolerance, int limit, Vector& solution,
                              GradientsWork<Vector>& work) {
  auto& [image, error, residual, direction] = work;
  Gradients result;
  times_matrix(solution, image);
  residual = right_hand_side - image;
  result.converged = residual.isZero(0);
  if (result.converged) return result;
  precondition(residual, error);
  direction = error;
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
    combine(step, direction, 1, solution);
    combine(-step, image, 1, residual);
    precondition(residual, error);
    // Polak, Ribière: a preconditioner need not be quite the same from one iteration to the next.
    const auto [error_image, error_residual] = products<Vector, 2>(error, {&image, &residual});
    combine(1, error, -step * error_image / square, direction);
    square = error_residual;
    ++result.iterations;
  }
  return result;
}

template <typename Vector, typename TimesMatrix, typename Precondition>
Gradients conjugate_gradients(const TimesMatrix& times_matrix, const Precondition& precondition,
                              const Vector& right_hand_side, double tolerance, int limit, Vector& solution) {
  GradientsWork<Vector> work;
  return conjugate_gradients(times_matrix, precondition, right_hand_side, tolerance, limit, solution, work);
}

}  // namespace swage
