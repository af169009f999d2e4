// What a solution in double precision lacks, by preconditioned conjugate gradients in single precision: half the memory
// to go through, and the residual tells in double what is left.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "merge.h"
#include "vectors.h"

namespace swage {

/// Vectors to be used again. The caller sets `residual`, and finds what is lacking in `change`, and in `error` about
/// what is lacking still.
struct CorrectionWork {
  Values<float> residual, change, error, image, direction;
};

struct Correction {
  int iterations = 0;
  double first = 0, last = 0;  ///< residual · preconditioned residual: about the square of the error, by its energy.

  bool gained() const { return std::abs(last) < 0.5 * std::abs(first); }
};

/// Of vectors in single precision, in double but for short stretches.
template <size_t kCount>
std::array<double, kCount> dots(const Values<float>& vector, const std::array<const Values<float>*, kCount>& others) {
  constexpr Eigen::Index kShort = 256;
  Eigen::Array<double, static_cast<int>(kCount), Eigen::Dynamic> parts(kCount, stretch_count(vector.size()));
  each_stretch(vector.size(), [&](Eigen::Index begin, Eigen::Index count, Eigen::Index stretch) {
    Eigen::Array<double, static_cast<int>(kCount), 1> sums = Eigen::Array<double, static_cast<int>(kCount), 1>::Zero();
    for (Eigen::Index at = begin; at < begin + count; at += kShort) {
      const Eigen::Index entries = std::min(kShort, begin + count - at);
      for (size_t k = 0; k < kCount; ++k) {
        sums[static_cast<Eigen::Index>(k)] +=
            static_cast<double>(vector.segment(at, entries).dot(others[k]->segment(at, entries)));
      }
    }
    parts.col(stretch) = sums;
  });
  std::array<double, kCount> sums = {};
  for (Eigen::Index i = 0; i < parts.cols(); ++i) {
    for (size_t k = 0; k < kCount; ++k) sums[k] += parts(static_cast<Eigen::Index>(k), i);
  }
  return sums;
}
inline double dot(const Values<float>& a, const Values<float>& b) { return dots<1>(a, {&b})[0]; }

/// Until the square is `enough(first)` or below, for `limit` iterations, or until rounding makes the matrix or the
/// preconditioner indefinite. `times_matrix(x, y)` makes y the product and returns x · y; `precondition(r, e)` makes e
/// about the error that leaves the residual r.
template <typename TimesMatrix, typename Precondition, typename Enough>
Correction correct(const TimesMatrix& times_matrix, const Precondition& precondition, const Enough& enough, int limit,
                   CorrectionWork& work) {
  constexpr double kLongest = 1e4;  // Farther goes only what rounding made.
  auto& [residual, change, error, image, direction] = work;
  Correction result;
  change.setZero(residual.size());
  precondition(residual, error);
  direction = error;
  result.first = result.last = dot(residual, error);
  const double due = enough(result.first);
  while (result.last > due && result.iterations < limit) {
    const double bend = times_matrix(direction, image);
    if (!(bend > 0)) break;
    const double step = result.last / bend;
    if (step > kLongest) break;
    combine(step, direction, 1, change);
    combine(-step, image, 1, residual);
    precondition(residual, error);
    // Polak, Ribière: rounding makes the preconditioner a little another one each time.
    const auto [error_image, error_residual] = dots<2>(error, {&image, &residual});
    combine(1, error, -step * error_image / result.last, direction);
    result.last = error_residual;
    ++result.iterations;
  }
  return result;
}

/// Improves what one cycle on a level found by another, so that the energy of both together is least: whatever a level
/// is too stiff or too soft for. `cycle(r, e)` makes e about the error that leaves the residual r; `clear(r)` takes out
/// of a residual what means nothing.
template <typename Matrix, typename Cycle, typename Clear>
void join_twice(const Matrix& matrix, const Cycle& cycle, const Clear& clear, const Values<float>& residual,
                Values<float>& error, std::array<Values<float>, 4>& work) {
  constexpr double kLittle = 0.01;
  auto& [rest, more, image, image_more] = work;
  const double bend = matrix.multiply(error, image);
  if (!(bend > 0)) return;
  const double step = dot(error, residual) / bend;
  rest = residual;
  combine(-step, image, 1, rest);
  clear(rest);
  if (dot(rest, rest) < kLittle * dot(residual, residual)) return combine(0, error, step, error);
  if (more.size() != rest.size()) more.setZero(rest.size());
  cycle(rest, more);
  const double bend_more = matrix.multiply(more, image_more), shared = dot(more, image);
  const double own = bend_more - shared * shared / bend;
  const double step_more = own > 1e-6 * bend_more ? dot(more, rest) / own : 0;
  combine(step_more, more, step - step_more * shared / bend, error);
}

/// How far to go before it is asked again which unknowns stand at their bounds.
class Approach {
 public:
  /// `tolerance`: part of the first error, whose square may be given. `rounding`: a square below which nothing is to be
  /// gained.
  Approach(double tolerance, double rounding, double first = -1)
      : tolerance_(tolerance), rounding_(rounding), first_(first) {}

  /// For correct().
  double enough(double square) {
    constexpr double kRound = 3e-3;
    if (first_ < 0) first_ = square;
    return std::max({kRound * kRound * square, part_ * part_ * due(), rounding_});
  }
  double first() const { return first_; }
  bool there(const Correction& correction) const { return std::abs(correction.last) <= due(); }
  /// How far off an unknown may be whose change costs this weight times its square: a tenth of what may be left in all.
  double negligible(double weight) const { return 0.1 * std::sqrt(due() / weight); }
  /// From now on goes on to a tenth of the error. False where that is too little to tell anything.
  bool tighten() {
    part_ *= 0.1;
    return part_ >= 1e-4;
  }

 private:
  double due() const { return std::max(tolerance_ * tolerance_ * first_, rounding_); }

  double tolerance_, rounding_, first_, part_ = 1;
};

}  // namespace swage
