// Rows of scales along their axis, whose means are given.
#pragma once

#include <algorithm>

#include "scale_matrix.h"

namespace swage {

/// So many rows side by side are worked at once.
constexpr Eigen::Index kSide = 256;

/// Where the rows along an axis begin, after those along the axes before it.
Eigen::Index first_row(const ScaleLayout& layout, int axis);

/// Calls work(begin, count, stride of the next along the row, row) for stretches of rows that lie side by side. Called
/// by all threads of a parallel region, which share the stretches and do not wait for each other.
template <typename Work>
void each_rows(const ScaleLayout& layout, int axis, const Work& work) {
  const Extents& extents = layout.extents[static_cast<size_t>(axis)];
  const Eigen::Index inner = extents.stride(axis), step = inner * extents[axis], outer = extents.count() / step;
  const Eigen::Index parts = (inner + kSide - 1) / kSide, begin = layout.begins[static_cast<size_t>(axis)];
#pragma omp for schedule(static) nowait
  for (Eigen::Index i = 0; i < outer * parts; ++i) {
    const Eigen::Index first = i % parts * kSide;
    work(begin + i / parts * step + first, std::min(kSide, inner - first), inner, i / parts * inner + first);
  }
}

/// Rows whose sums stay: what one scale lacks others of its row take on by their weights, which are above 0 where a
/// scale may change. A constant along a row of the residual means nothing. It is taken out by the weighted mean, since
/// single precision would lose beside it what little there is where weights are large.
struct Rows {
  const ScaleLayout& layout;
  const Values<float>& weights;
  const Values<float>& inverse_sums;  // Of each row's weights, or 0.

  /// Puts or adds factor · weight · (residual less its mean).
  template <bool kAdd>
  void spread(float factor, const Values<float>& residual, Values<float>& error) const;
  /// Takes the mean out, and all where scales may not change. Into another vector or the same.
  template <typename From>
  void center(const Values<From>& residual, Values<float>& rest) const;
  /// Adds the error to values, or to nothing, so that rows' sums stay.
  void add(const Values<float>& error, Values<double>& values) const;
  void balance(Values<float>& error) const;

 private:
  template <typename Wide, typename Summand, typename Put>
  void each(const Summand& summand, const Put& put) const;
};

void sum_rows(const ScaleLayout& layout, const Values<float>& weights, Values<float>& inverse_sums);

}  // namespace swage
