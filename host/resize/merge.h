// Coarser arrays for multigrid: two neighbours along an axis become one.
#pragma once

#include <Eigen/Core>
#include <array>

#include "grid.h"

namespace swage {

template <typename Scalar>
using Values = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

inline int next(int axis) { return (axis + 1) % 3; }

/// Below so many entries threads cost more than they bring.
constexpr Eigen::Index kManyEntries = 30'000;

/// Of weights between pairs of neighbours, each a way of 1 long, this part stands for the way of 2 between merged ones.
constexpr float kLongerWay = 0.8F;

/// The axes along which neighbours are merged.
using Merged = std::array<bool, 3>;

Extents merge(const Extents& fine, const Merged& merged);

/// Sums over what is merged, and the transpose, which adds to what is there.
template <typename Scalar>
void gather(const Extents& fine, const Merged& merged, const Scalar* from, Scalar* to);
template <typename Scalar>
void scatter_add(const Extents& fine, const Merged& merged, const Scalar* from, Scalar* to);

/// Weights between neighbours along `axis`, which is merged: those within a merged pair drop out.
void gather_weights(const Extents& fine, const Merged& merged, int axis, const float* from, float* to);

}  // namespace swage
