// Sums over all elements of a launch.
#pragma once

#include "kernel.h"

namespace swage {

/// Three sums an item, as kernels leave them (kernels/shared/lane_sums.h), and their totals: by blocks on the device,
/// then here, in their order.
class Sums {
 public:
  Sums(const Queue& queue, Eigen::Index items);

  /// For a kernel to write.
  const Reals& of_items() const { return items_; }
  /// Launches the sums by blocks.
  void add_up();
  /// Waits.
  Eigen::Vector3d total() const;

 private:
  int count_, blocks_;
  Reals items_, sums_;
  Kernel add_up_;
};

}  // namespace swage
