// The matrix of the scale solve, on the cells and on coarser grids for multigrid.
//
// Scales along u couple only within a layer of cells across u, and with the other axes' scales in the same cell. On
// coarser grids two by two cells across u are one, and none are merged along u: what differs from layer to layer costs
// nothing but the little that other axes' scales resist. So rows along u stay what they are, and a correction that
// leaves the rows' sums alone on a coarse grid does so on the cells.
#pragma once

#include <Eigen/Core>
#include <array>

#include "merge.h"

namespace swage {

/// The scales along x, then those along y and z; zeros before, between and after, as many as any neighbour is away, so
/// that a stencil needs no borders.
struct ScaleLayout {
  explicit ScaleLayout(const Extents& cells, int halvings = 0);

  std::array<Extents, 3> extents;      // Of the scales along each axis.
  std::array<Eigen::Index, 3> begins;  // Where they begin.
  Eigen::Index size;
  int halvings;
};

/// The axes along which scales along u are merged: all but u.
Merged across(int u);

template <typename Scalar>
struct ScaleMatrix {
  explicit ScaleMatrix(const ScaleLayout& of) : layout(of) {}

  ScaleLayout layout;
  Values<Scalar> neighbours;              // Sum of the weights below of a cell and those that end in it.
  std::array<Values<Scalar>, 2> weights;  // Between a cell and the one after it along next(u), next(next(u)).
  // What depends on the factors: the diagonal, and minus the entries of pairs of axes u, next(u). Those lie on the
  // cells, merged only along the third axis.
  Values<Scalar> diagonal;
  std::array<Values<Scalar>, 3> pairs;

  Extents pair_extents(int p) const;
  void multiply(const Values<Scalar>& x, Values<Scalar>& product) const;

 private:
  void multiply_pairs(int p, const Values<Scalar>& x, Values<Scalar>& product) const;
};

/// Takes the weighted mean out of rows, and adds or puts what is left, times weights and factor, to another vector or
/// the same. In double precision where either is.
template <typename Scalar>
struct RowSpread {
  const ScaleLayout& layout;
  const Values<Scalar>& weights;
  Values<Scalar> inverse_sums = {};  // Of each row's weights, or 0.

  void sum();
  template <bool kAdd, typename From, typename To>
  void apply(Scalar factor, const Values<From>& from, Values<To>& to) const;
};

}  // namespace swage
