// One level of a multigrid hierarchy: a block Jacobi sweep, a residual, and the way to the next level.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "aggregation.h"

namespace swage {

constexpr int kLanes = 8;
using Lanes = Eigen::Array<float, kLanes, 1>;

/// Matrices of kLanes elements in a row stand side by side, entry by entry.
class LaneRows {
 public:
  LaneRows() = default;
  LaneRows(Eigen::Index rows, Eigen::Index width)
      : width_(width), lanes_(static_cast<size_t>(rows * width), Lanes::Zero()) {}

  float& operator()(Eigen::Index row, Eigen::Index entry, Eigen::Index lane) {
    return lanes_[static_cast<size_t>(row * width_ + entry)][lane];
  }
  void set_zero() { std::fill(lanes_.begin(), lanes_.end(), Lanes::Zero()); }
  const Lanes* row(Eigen::Index row) const { return lanes_.data() + row * width_; }
  std::size_t bytes() const { return lanes_.size() * sizeof(Lanes); }

 private:
  Eigen::Index width_ = 0;
  std::vector<Lanes> lanes_;
};

/// Templates are for elements of so many rows, as the level's are.
struct Level {
  /// Structure alone.
  Level(const ElementGraph& graph, const Couplings& couplings, const Poll& poll = {});

  int rows;
  Eigen::Index count;
  LaneRows own, inverse;
  // Of kLanes elements in a row each has as many slots for neighbours as the one with most: what is left over couples
  // an element to itself.
  std::vector<Eigen::Index> slots;  // Of each row the first, and the end.
  std::vector<int> neighbours;      // Slot by slot, kLanes each.
  LaneRows values;
  std::vector<std::array<Eigen::Index, 2>> places;  // Of each pair its neighbours' places, or -1.
  std::vector<int> into;                            // Of each element, on the next level.
  std::vector<int> part_offsets, parts;             // Of each element of the next level those merged into it.
  std::vector<int> coarse_pairs;  // Of each pair, on the next level, or -1 where it is within an element.

  Eigen::Index unknowns() const { return count * 3 * rows; }
  Eigen::Index coarse_count() const { return static_cast<Eigen::Index>(part_offsets.size()) - 1; }
  std::size_t bytes() const {
    return own.bytes() + inverse.bytes() + values.bytes() + slots.size() * sizeof(Eigen::Index) +
           places.size() * sizeof(places[0]) +
           (neighbours.size() + into.size() + part_offsets.size() + parts.size() + coarse_pairs.size()) * sizeof(int);
  }

  /// `pairs` are this level's, `couplings` the next one's, whose pairs it returns.
  std::vector<std::pair<int, int>> merge_into(std::vector<int> coarse, const std::vector<std::pair<int, int>>& pairs,
                                              const Couplings& couplings, const Poll& poll = {});
  void fill(const ElementGraph& graph, const Poll& poll = {});
  /// The sums on the next level, whose pairs stand there already.
  void coarsen(const ElementGraph& graph, ElementGraph& coarse) const;

  /// A sweep from nothing.
  template <int kRows>
  void begin(const Eigen::VectorXf& right, Eigen::VectorXf& x) const;
  template <int kRows>
  void multiply(const Eigen::VectorXf& x, Eigen::VectorXf& image) const;
  template <int kRows>
  void residual(const Eigen::VectorXf& right, const Eigen::VectorXf& x, Eigen::VectorXf& left) const;
  /// A sweep from x.
  template <int kRows>
  void sweep(const Eigen::VectorXf& right, const Eigen::VectorXf& x, Eigen::VectorXf& swept) const;
  template <int kRows>
  void gather(const Eigen::VectorXf& fine, Eigen::VectorXf& coarse) const;
  template <int kRows>
  void scatter(const Eigen::VectorXf& coarse, Eigen::VectorXf& fine) const;

 private:
  Eigen::Index lane_rows() const { return (count + kLanes - 1) / kLanes; }
  template <typename Work>
  void each_row(const Work& work) const;
  template <int kRows>
  void invert(Eigen::Index first, Eigen::Index end);
  template <int kRows>
  void load(const Eigen::VectorXf& x, Eigen::Index row, Lanes* lanes) const;
  template <int kRows>
  void store(const Lanes* lanes, Eigen::Index row, Eigen::VectorXf& x) const;
  /// The matrix times x, of a row of elements.
  template <int kRows>
  void row_product(const Eigen::VectorXf& x, Eigen::Index row, Lanes* product) const;
};

}  // namespace swage
