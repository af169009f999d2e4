#include "scale_matrix.h"

#include <algorithm>
#include <type_traits>

namespace swage {
namespace {

using Eigen::Index;

/// Takes from the products what the entries between two lines couple.
template <typename Scalar>
void couple(const Scalar* entries, const Scalar* a, const Scalar* b, Index count, Scalar* __restrict of_a,
            Scalar* __restrict of_b) {
  for (Index i = 0; i < count; ++i) {
    of_a[i] -= entries[i] * b[i];
    of_b[i] -= entries[i] * a[i];
  }
}

/// The same, where so many of the line a are merged in one of b.
template <typename Scalar, typename Width>
void couple_merged(const Scalar* entries, const Scalar* a, const Scalar* b, Index count, Width width,
                   Scalar* __restrict of_a, Scalar* __restrict of_b) {
  const auto one = [&](Index group, Index end) {
    Scalar sum = 0;
    for (Index i = group * width; i < end; ++i) {
      of_a[i] -= entries[i] * b[group];
      sum += entries[i] * a[i];
    }
    of_b[group] -= sum;
  };
  const Index groups = count / width;
  for (Index group = 0; group < groups; ++group) one(group, (group + 1) * width);
  if (groups * width < count) one(groups, count);
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

/// The lines of scales that couple with each other alone but for neighbours: one along x of those along x, and of those
/// along y and z as many as are merged in it. Lines of those along y lie one after another.
template <typename Scalar>
struct ScaleMatrix<Scalar>::Block {
  Block(const ScaleMatrix& matrix, Index number) {
    const ScaleLayout& of = matrix.layout;
    const auto& [x, y, z] = of.extents;
    const int j = static_cast<int>(number % x[1]), k = static_cast<int>(number / x[1]), width = 1 << of.halvings;
    const int first_y = j * width, first_z = k * width;
    count_y = std::min(width, y[1] - first_y);
    count_z = std::min(width, z[2] - first_z);
    length_x = x[0];
    length = y[0];
    line_x = of.begins[0] + x.at(0, j, k);
    line_y = of.begins[1] + y.at(0, first_y, k);
    line_z = of.begins[2] + z.at(0, j, first_z);
    stride_z = z.stride(2);
    xy = matrix.pairs[0].data() + matrix.pair_extents(0).at(0, first_y, k);
    yz = matrix.pairs[1].data() + matrix.pair_extents(1).at(0, first_y, first_z);
    zx = matrix.pairs[2].data() + matrix.pair_extents(2).at(0, j, first_z);
    stride_yz = matrix.pair_extents(1).stride(2);
    stride_zx = matrix.pair_extents(2).stride(2);
  }

  template <typename Work>
  void each_stretch(const Work& work) const {
    work(0, line_x, length_x);
    work(1, line_y, count_y * length);
    for (Index k = 0; k < count_z; ++k) work(2, line_z + k * stride_z, length);
  }

  Index count_y, count_z, length_x, length, line_x, line_y, line_z, stride_z;
  const Scalar *xy, *yz, *zx;  // Entries of pairs.
  Index stride_yz, stride_zx;
};

template <typename Scalar>
void ScaleMatrix<Scalar>::stencil(int u, Index at, Index count, const Scalar* x, Scalar* __restrict product) const {
  const Extents& extents = layout.extents[static_cast<size_t>(u)];
  const Index a = extents.stride(next(u)), b = extents.stride(next(next(u)));
  const Scalar *beyond = own.data(), *to_a = weights[0].data(), *to_b = weights[1].data();
  // So written that little is lost where neighbours have about the same.
  for (Index i = at; i < at + count; ++i) {
    product[i] = beyond[i] * x[i] + to_a[i] * (x[i] - x[i + a]) + to_a[i - a] * (x[i] - x[i - a]) +
                 to_b[i] * (x[i] - x[i + b]) + to_b[i - b] * (x[i] - x[i - b]);
  }
}

/// What is coupled within a cell, and in what is merged.
template <typename Scalar>
void ScaleMatrix<Scalar>::couple_axes(const Block& block, const Scalar* x, Scalar* product) const {
  const auto with_x = [&](const Scalar* entries, Index other) {
    const auto merged = [&](auto width) {
      couple_merged(entries, x + block.line_x, x + other, block.length_x, width, product + block.line_x,
                    product + other);
    };
    switch (layout.halvings) {  // Of a width that the compiler knows where much is to be done.
      case 0:
        return couple(entries, x + block.line_x, x + other, block.length, product + block.line_x, product + other);
      case 1:
        return merged(std::integral_constant<Index, 2>());
      case 2:
        return merged(std::integral_constant<Index, 4>());
      case 3:
        return merged(std::integral_constant<Index, 8>());
      default:
        return merged(Index{1} << layout.halvings);
    }
  };
  for (Index j = 0; j < block.count_y; ++j) {
    with_x(block.xy + j * block.length_x, block.line_y + j * block.length);
  }
  for (Index k = 0; k < block.count_z; ++k) {
    const Index line_z = block.line_z + k * block.stride_z;
    with_x(block.zx + k * block.stride_zx, line_z);
    for (Index j = 0; j < block.count_y; ++j) {
      const Index line_y = block.line_y + j * block.length;
      couple(block.yz + k * block.stride_yz + j * block.length, x + line_y, x + line_z, block.length, product + line_y,
             product + line_z);
    }
  }
}

/// Makes the product block by block; `finish` is called with where a stretch of it begins, its length and its block's
/// number when it is done.
template <typename Scalar>
template <typename Finish>
void ScaleMatrix<Scalar>::each_block(const Values<Scalar>& x, Values<Scalar>& product, const Finish& finish) const {
  if (product.size() != layout.size) product.setZero(layout.size);
#pragma omp parallel for schedule(static) if (layout.large())
  for (Index number = 0; number < block_count(); ++number) {
    const Block block(*this, number);
    block.each_stretch([&](int u, Index at, Index count) { stencil(u, at, count, x.data(), product.data()); });
    couple_axes(block, x.data(), product.data());
    block.each_stretch([&](int, Index at, Index count) { finish(at, count, number); });
  }
}

template <typename Scalar>
double ScaleMatrix<Scalar>::multiply(const Values<Scalar>& x, Values<Scalar>& product) const {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(block_count());
  each_block(x, product, [&](Index at, Index count, Index block) {
    sums[block] += static_cast<double>(x.segment(at, count).dot(product.segment(at, count)));
  });
  return sums.sum();
}

template <typename Scalar>
void ScaleMatrix<Scalar>::subtract(const Values<Scalar>& side, const Values<Scalar>& x, Values<Scalar>& rest) const {
  each_block(x, rest, [&](Index at, Index count, Index) {
    rest.segment(at, count) = side.segment(at, count) - rest.segment(at, count);
  });
}

template struct ScaleMatrix<float>;
template struct ScaleMatrix<double>;

}  // namespace swage
