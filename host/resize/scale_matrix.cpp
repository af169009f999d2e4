#include "scale_matrix.h"

#include <algorithm>
#include <type_traits>

namespace swage {
namespace {

using Eigen::Index;

// So many rows side by side are summed at once.
constexpr Index kSide = 256;

constexpr Index kStencils = 4096;  // So many in a row are worked at once.

bool large(const ScaleLayout& layout) { return layout.size > 3 * kManyEntries; }

template <typename Scalar>
auto part(const Values<Scalar>& values, Index begin, Index count) {
  return values.segment(begin, count).array();
}

template <typename Scalar>
auto part(const Scalar* values, Index count) {
  return Eigen::Map<const Eigen::Array<Scalar, Eigen::Dynamic, 1>>(values, count);
}

}  // namespace

ScaleLayout::ScaleLayout(const Extents& cells, int of_halvings) : halvings(of_halvings) {
  Index pad = 0;
  for (int u = 0; u < 3; ++u) {
    Extents& own = extents[static_cast<size_t>(u)] = cells;
    for (int h = 0; h < halvings; ++h) own = merge(own, across(u));
    pad = std::max(pad, own.stride(2));
  }
  size = pad;
  for (size_t u = 0; u < 3; ++u) {
    begins[u] = size;
    size += extents[u].count() + pad;
  }
}

Merged across(int u) {
  Merged merged = {true, true, true};
  merged[static_cast<size_t>(u)] = false;
  return merged;
}

template <typename Scalar>
Extents ScaleMatrix<Scalar>::pair_extents(int p) const {
  const int q = next(p), third = next(q);
  Extents extents;
  extents[p] = layout.extents[static_cast<size_t>(p)][p];
  extents[q] = layout.extents[static_cast<size_t>(q)][q];
  extents[third] = layout.extents[static_cast<size_t>(p)][third];
  return extents;
}

template <typename Scalar>
void ScaleMatrix<Scalar>::multiply(const Values<Scalar>& x, Values<Scalar>& product) const {
  if (product.size() != layout.size) product.setZero(layout.size);
#pragma omp parallel if (large(layout))
  for (size_t u = 0; u < 3; ++u) {
    const Extents& extents = layout.extents[u];
    const int v = next(static_cast<int>(u)), w = next(v);
    const Index a = extents.stride(v), b = extents.stride(w);
#pragma omp for schedule(static) nowait
    for (Index begin = 0; begin < extents.count(); begin += kStencils) {
      const Index at = layout.begins[u] + begin, count = std::min(kStencils, extents.count() - begin);
      product.segment(at, count).array() = part(diagonal, at, count) * part(x, at, count) -
                                           part(weights[0], at, count) * part(x, at + a, count) -
                                           part(weights[0], at - a, count) * part(x, at - a, count) -
                                           part(weights[1], at, count) * part(x, at + b, count) -
                                           part(weights[1], at - b, count) * part(x, at - b, count);
      if (layout.halvings > 0) continue;
      const auto before = static_cast<size_t>(w), after = static_cast<size_t>(v);
      product.segment(at, count).array() -=
          part(pairs[u], begin, count) * part(x, layout.begins[after] + begin, count) +
          part(pairs[before], begin, count) * part(x, layout.begins[before] + begin, count);
    }
  }
  if (layout.halvings == 0) return;
  for (int p = 0; p < 3; ++p) multiply_pairs(p, x, product);
}

template <typename Scalar>
void ScaleMatrix<Scalar>::multiply_pairs(int p, const Values<Scalar>& x, Values<Scalar>& product) const {
  const int q = next(p), third = next(q);
  const Extents cells = pair_extents(p);
  const Extents &of_p = layout.extents[static_cast<size_t>(p)], &of_q = layout.extents[static_cast<size_t>(q)];
  // Runs go along the lower of the two axes, which lies closer.
  const int run = std::min(p, q), other = std::max(p, q);
  const Extents &runs = run == p ? of_p : of_q, &others = run == p ? of_q : of_p;
  const Index run_begin = layout.begins[static_cast<size_t>(run)],
              other_begin = layout.begins[static_cast<size_t>(other)];
  const Values<Scalar>& values = pairs[static_cast<size_t>(p)];
  const int width = 1 << layout.halvings;
#pragma omp parallel for schedule(static) if (cells.count() > kManyEntries)
  for (int k = 0; k < cells[third]; ++k) {
    for (int j = 0; j < cells[other]; ++j) {
      const Index value = k * cells.stride(third) + j * cells.stride(other);
      const Index in_runs = run_begin + k * runs.stride(third) + j / width * runs.stride(other);
      const Index in_others = other_begin + k * others.stride(third) + j * others.stride(other);
      for (int merged = 0; merged < others[run]; ++merged) {
        const Index single = in_others + merged * others.stride(run);
        const Scalar at_other = x[single];
        Scalar sum = 0;
        for (int i = merged * width; i < std::min((merged + 1) * width, cells[run]); ++i) {
          const Scalar entry = values[value + i * cells.stride(run)];
          const Index at = in_runs + i * runs.stride(run);
          product[at] -= entry * at_other;
          sum += entry * x[at];
        }
        product[single] -= sum;
      }
    }
  }
}

namespace {

/// Where the rows along an axis begin, after those along the axes before it.
Index first_row(const ScaleLayout& layout, int axis) {
  Index rows = 0;
  for (int u = 0; u < axis; ++u) {
    const Extents& extents = layout.extents[static_cast<size_t>(u)];
    rows += extents.count() / extents[u];
  }
  return rows;
}

/// Calls work(begin, count, stride of the next along the row, row) for stretches of rows that lie side by side. Called
/// by all threads of a parallel region, which share the stretches and do not wait for each other.
template <typename Work>
void each_rows(const ScaleLayout& layout, int axis, const Work& work) {
  const Extents& extents = layout.extents[static_cast<size_t>(axis)];
  const Index inner = extents.stride(axis), step = inner * extents[axis], outer = extents.count() / step;
  const Index parts = (inner + kSide - 1) / kSide;
#pragma omp for schedule(static) nowait
  for (Index i = 0; i < outer * parts; ++i) {
    const Index first = i % parts * kSide;
    work(i / parts * step + first, std::min(kSide, inner - first), inner, i / parts * inner + first);
  }
}

}  // namespace

template <typename Scalar>
void RowSpread<Scalar>::sum() {
  inverse_sums.resize(first_row(layout, 3));
#pragma omp parallel if (large(layout))
  for (int u = 0; u < 3; ++u) {
    const Extents& extents = layout.extents[static_cast<size_t>(u)];
    const Scalar* own = weights.data() + layout.begins[static_cast<size_t>(u)];
    Scalar* sums = inverse_sums.data() + first_row(layout, u);
    each_rows(layout, u, [&](Index first, Index count, Index stride, Index row) {
      for (Index r = 0; r < count; ++r) {
        Scalar total = 0;
        for (Index i = 0; i < extents[u]; ++i) total += own[first + r + i * stride];
        sums[row + r] = total > 0 ? 1 / total : 0;
      }
    });
  }
}

template <typename Scalar>
template <bool kAdd, typename From, typename To>
void RowSpread<Scalar>::apply(Scalar factor, const Values<From>& from, Values<To>& to) const {
  using Wide = std::common_type_t<From, To>;
  using Side = Eigen::Array<Wide, Eigen::Dynamic, 1, 0, kSide, 1>;
  if (to.size() != layout.size) to.setZero(layout.size);
#pragma omp parallel if (large(layout))
  for (int u = 0; u < 3; ++u) {
    const Extents& extents = layout.extents[static_cast<size_t>(u)];
    const Index start = layout.begins[static_cast<size_t>(u)], length = extents[u], begin = first_row(layout, u);
    each_rows(layout, u, [&](Index first, Index count, Index stride, Index row) {
      const Scalar* own = weights.data() + start + first;
      const From* source = from.data() + start + first;
      To* target = to.data() + start + first;
      if (stride == 1) {  // A row along x lies in one piece.
        Wide mean = 0;
        for (Index i = 0; i < length; ++i) mean += static_cast<Wide>(own[i]) * static_cast<Wide>(source[i]);
        mean *= static_cast<Wide>(inverse_sums[begin + row]);
        for (Index i = 0; i < length; ++i) {
          const Wide spread = static_cast<Wide>(factor * own[i]) * (static_cast<Wide>(source[i]) - mean);
          target[i] = static_cast<To>((kAdd ? static_cast<Wide>(target[i]) : 0) + spread);
        }
        return;
      }
      Side mean = Side::Zero(count);
      for (Index i = 0; i < length; ++i) {
        mean += part(own + i * stride, count).template cast<Wide>() *
                part(source + i * stride, count).template cast<Wide>();
      }
      mean *= part(inverse_sums.data() + begin + row, count).template cast<Wide>();
      for (Index i = 0; i < length; ++i) {
        Eigen::Map<Eigen::Array<To, Eigen::Dynamic, 1>> put(target + i * stride, count);
        const auto spread = (factor * part(own + i * stride, count)).template cast<Wide>() *
                            (part(source + i * stride, count).template cast<Wide>() - mean);
        if constexpr (kAdd) {
          put += spread.template cast<To>();
        } else {
          put = spread.template cast<To>();
        }
      }
    });
  }
}

template struct ScaleMatrix<float>;
template struct ScaleMatrix<double>;
template struct RowSpread<float>;
template struct RowSpread<double>;
template void RowSpread<float>::apply<false>(float, const Values<float>&, Values<float>&) const;
template void RowSpread<float>::apply<true>(float, const Values<float>&, Values<float>&) const;
template void RowSpread<double>::apply<false>(double, const Values<double>&, Values<float>&) const;
template void RowSpread<double>::apply<false>(double, const Values<float>&, Values<double>&) const;

}  // namespace swage
