// What rotation and similarity share: the covariances of each element's pairs and normals.
#pragma once

#include "kernel.h"
#include "swage/steps.h"

namespace swage {

/// How the device sees a shape: about its first vertex, the rest shape's size as unit, the largest weight 1. So single
/// precision bears any size and any place.
struct PairScales {
  explicit PairScales(const PairsRest& rest);
  double per_length, per_weight;
};

/// The elements of `rest`.
Eigen::Index elements_of(const PairsRest& rest);

class PairSums {
 public:
  PairSums(const Queue& queue, const PairsRest& rest);

  Eigen::Index count() const { return count_; }
  /// How far apart columns begin: there is room for the elements of whole items of kernels in lanes.
  int stride() const { return stride_; }
  /// Of kernels in lanes.
  Eigen::Index items() const { return stride_ / lanes_; }
  /// stride × 9, in columns: sum_p w_p b_p a_pᵀ, and the same with the normals.
  const Reals& edges() const { return edge_sums_; }
  const Reals& all() const { return normals_ ? all_sums_ : edge_sums_; }

  void gather(const Positions& positions, const Positions& targets);

 private:
  PairSums(const Queue& queue, const PairsRest& rest, const PairScales& scales);

  PairScales scales_;
  Eigen::Index count_;
  int lanes_, stride_;
  bool normals_;
  Ints offsets_, pairs_;
  Reals edges_, weighted_normals_;
  Reals positions_, targets_, edge_sums_, all_sums_;
  Kernel gather_pairs_, add_normals_;
};

}  // namespace swage
