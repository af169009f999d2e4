// What rotation and similarity share: each element's pairs and normals.
#pragma once

#include "kernel.h"
#include "lane_items.h"
#include "swage/steps.h"

namespace swage {

/// How the device sees a shape: the rest shape's size as unit, the largest weight 1. So single precision bears any
/// size.
struct PairScales {
  explicit PairScales(const PairsRest& rest);
  double per_length, per_weight;
};

/// The elements of `rest`.
Eigen::Index elements_of(const PairsRest& rest);

/// On the device, for kernels/<stem>.cl.
class Pairs {
 public:
  Pairs(const Queue& queue, const PairsRest& rest, const char* stem);

  /// What `kernel` fits to the pairs now, a row an element, for `function` of the step; `of_element` are arguments
  /// before the positions.
  template <typename... OfElement>
  void fit(const char* function, Kernel& kernel, const Positions& positions, const Positions& targets,
           Transforms& result, const OfElement&... of_element) {
    result.resize(elements_.count, 9);
    fit_rows(function, kernel, positions, targets, result, result_, of_element...);
  }
  /// Likewise, of as many columns as `result` has and `rows` has room for.
  template <typename Result, typename... OfElement>
  void fit_rows(const char* function, Kernel& kernel, const Positions& positions, const Positions& targets,
                Result& result, HostRows& rows, const OfElement&... of_element) {
    check_rows(function, "positions", positions.rows(), vertices_);
    check_rows(function, "targets", targets.rows(), normals_.size() / 3);
    const Visit visit(queue_, {&positions_, &targets_, &rows});
    show(positions, targets);
    rows.lend(result);
    kernel.launch(elements_.items(), elements_.count, HostNumber{per_length_now()}, normals_.size() == 0 ? 0 : 1,
                  offsets_, pairs_, edges_, normals_, of_element..., positions_, targets_, rows);
    rows.take_back(result);
  }

  const LaneItems& elements() const { return elements_; }

 private:
  Pairs(const Queue& queue, const PairsRest& rest, const char* stem, const PairScales& scales);
  using Index = Eigen::Index;
  void show(const Positions& positions, const Positions& targets);
  /// What is left to scale of the positions that kernels see.
  double per_length_now() const { return queue_.context->in_host_memory() ? per_length_ : 1; }

  Queue queue_;
  Index vertices_;
  double per_length_;
  LaneItems elements_;
  Ints offsets_, pairs_;
  Reals edges_, normals_;
  HostRows positions_, targets_, result_;
};

}  // namespace swage
