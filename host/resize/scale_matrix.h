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

  bool large() const { return size > 3 * kManyEntries; }
};

/// The axes along which scales along u are merged: all but u.
Merged across(int u);

template <typename Scalar>
struct ScaleMatrix {
  explicit ScaleMatrix(const ScaleLayout& of) : layout(of) {}

  ScaleLayout layout;
  std::array<Values<Scalar>, 2> weights;  // Between a cell and the one after it along next(u), next(next(u)).
  Values<Scalar> neighbours;              // Of a cell, the sum of those and of the weights that end in it.
  // What depends on the factors: the diagonal beyond those sums, and minus the entries of pairs of axes u, next(u).
  // Those lie on the cells, merged only along the third axis.
  Values<Scalar> own;
  std::array<Values<Scalar>, 3> pairs;

  Extents pair_extents(int p) const;
  /// x · product.
  double multiply(const Values<Scalar>& x, Values<Scalar>& product) const;
  /// What x leaves of the side.
  void subtract(const Values<Scalar>& side, const Values<Scalar>& x, Values<Scalar>& rest) const;

 private:
  struct Block;

  Eigen::Index block_count() const { return Eigen::Index{layout.extents[0][1]} * layout.extents[0][2]; }
  template <typename Finish>
  void each_block(const Values<Scalar>& x, Values<Scalar>& product, const Finish& finish) const;
  void stencil(int u, Eigen::Index at, Eigen::Index count, const Scalar* x, Scalar* product) const;
  void couple_axes(const Block& block, const Scalar* x, Scalar* product) const;
};

}  // namespace swage
