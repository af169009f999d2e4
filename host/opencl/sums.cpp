#include "sums.h"

#include "kernel_source.h"

namespace swage {

Sums::Sums(const Queue& queue, Eigen::Index items)
    : count_(static_cast<int>(items)),
      blocks_((count_ + kGroup - 1) / kGroup),
      items_(queue, 4 * items),
      sums_(queue, Eigen::Index{4} * blocks_),
      add_up_(queue, "transform", "add_up") {}

void Sums::add_up() { add_up_.launch(blocks_, count_, items_, sums_); }

Eigen::Vector3d Sums::total() const {
  Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor> sums(blocks_, 4);
  sums_.download(sums, Layout::rows);
  Eigen::Vector3d total = Eigen::Vector3d::Zero();
  for (const auto& block : sums.rowwise()) total += block.head<3>();
  return total;
}

}  // namespace swage
