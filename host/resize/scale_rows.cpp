#include "scale_rows.h"

#include <algorithm>
#include <type_traits>

namespace swage {

using Eigen::Index;

namespace {

constexpr double kLeast = 1e-300;

template <typename Scalar>
auto part(const Scalar* values, Index count) {
  return Eigen::Map<const Eigen::Array<Scalar, Eigen::Dynamic, 1>>(values, count);
}

template <typename Scalar>
auto part(Scalar* values, Index count) {
  return Eigen::Map<Eigen::Array<Scalar, Eigen::Dynamic, 1>>(values, count);
}

}  // namespace

Index first_row(const ScaleLayout& layout, int axis) {
  Index rows = 0;
  for (int u = 0; u < axis; ++u) {
    const Extents& extents = layout.extents[static_cast<size_t>(u)];
    rows += extents.count() / extents[u];
  }
  return rows;
}

void sum_rows(const ScaleLayout& layout, const Values<float>& weights, Values<float>& inverse_sums) {
  inverse_sums.resize(first_row(layout, 3));
#pragma omp parallel if (layout.large())
  for (int u = 0; u < 3; ++u) {
    const int length = layout.extents[static_cast<size_t>(u)][u];
    const Index begin = first_row(layout, u);
    each_rows(layout, u, [&](Index first, Index count, Index stride, Index row) {
      const float* own = weights.data() + first;
      auto sums = part(inverse_sums.data() + begin + row, count);
      sums.setZero();
      for (Index i = 0; i < length; ++i) sums += part(own + i * stride, count);
      sums = (sums > 0).select(sums.inverse(), 0.0F);
    });
  }
}

/// Calls put(begin, count, mean) for stretches that lie in one piece, with the sums of summand(begin, count) along the
/// rows over those of the weights.
template <typename Wide, typename Summand, typename Put>
void Rows::each(const Summand& summand, const Put& put) const {
  using Side = Eigen::Array<Wide, Eigen::Dynamic, 1, 0, kSide, 1>;
#pragma omp parallel if (layout.large())
  for (int u = 0; u < 3; ++u) {
    const int length = layout.extents[static_cast<size_t>(u)][u];
    const float* inverse = inverse_sums.data() + first_row(layout, u);
    each_rows(layout, u, [&](Index first, Index count, Index stride, Index row) {
      const auto weights_of = [&](Index at, Index entries) {
        return part(weights.data() + at, entries).template cast<Wide>();
      };
      constexpr bool kExact = std::is_same_v<Wide, double>;
      if (stride == 1) {  // A row along x lies in one piece.
        const Wide sum = summand(first, Index{length}).sum();
        const Wide inverse_sum =
            kExact ? 1 / std::max(weights_of(first, length).sum(), static_cast<Wide>(kLeast)) : inverse[row];
        put(first, Index{length}, inverse_sum * sum);
        return;
      }
      Side mean = summand(first, count), total = Side::Zero(count);
      for (Index i = 1; i < length; ++i) mean += summand(first + i * stride, count);
      if constexpr (kExact) {
        for (Index i = 0; i < length; ++i) total += weights_of(first + i * stride, count);
        mean /= total.max(kLeast);
      } else {
        mean *= part(inverse + row, count);
      }
      for (Index i = 0; i < length; ++i) put(first + i * stride, count, mean);
    });
  }
}

template <bool kAdd>
void Rows::spread(float factor, const Values<float>& residual, Values<float>& error) const {
  if (error.size() != layout.size) error.setZero(layout.size);
  const float *own = weights.data(), *from = residual.data();
  each<float>([&](Index at, Index count) { return part(own + at, count) * part(from + at, count); },
              [&](Index at, Index count, const auto& mean) {
                auto to = part(error.data() + at, count);
                if constexpr (!kAdd) to.setZero();
                to += factor * part(own + at, count) * (part(from + at, count) - mean);
              });
}

template <typename From>
void Rows::center(const Values<From>& residual, Values<float>& rest) const {
  if (rest.size() != layout.size) rest.setZero(layout.size);
  const float* own = weights.data();
  const From* from = residual.data();
  each<From>(
      [&](Index at, Index count) { return part(own + at, count).template cast<From>() * part(from + at, count); },
      [&](Index at, Index count, const auto& mean) {
        part(rest.data() + at, count) =
            (part(own + at, count) > 0).select((part(from + at, count) - mean).template cast<float>(), 0.0F);
      });
}

void Rows::add(const Values<float>& error, Values<double>& values) const {
  const float *own = weights.data(), *from = error.data();
  each<double>([&](Index at, Index count) { return part(from + at, count).cast<double>(); },
               [&](Index at, Index count, const auto& mean) {
                 part(values.data() + at, count) +=
                     part(from + at, count).cast<double>() - part(own + at, count).cast<double>() * mean;
               });
}

void Rows::balance(Values<float>& error) const {
  const float* own = weights.data();
  float* to = error.data();
  const auto may_change = [&](Index at, Index count) {
    return (part(own + at, count) > 0).select(part<float>(to + at, count), 0.0F);
  };
  each<float>(may_change, [&](Index at, Index count, const auto& mean) {
    part(to + at, count) = may_change(at, count) - part(own + at, count) * mean;
  });
}

template void Rows::spread<false>(float, const Values<float>&, Values<float>&) const;
template void Rows::spread<true>(float, const Values<float>&, Values<float>&) const;
template void Rows::center(const Values<float>&, Values<float>&) const;
template void Rows::center(const Values<double>&, Values<float>&) const;

}  // namespace swage
