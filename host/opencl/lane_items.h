// Elements as kernels in lanes see them: an item that many.
#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "kernel_source.h"

namespace swage {

struct LaneItems {
  int count, lanes;

  /// As many as are launched.
  int items() const { return (count + lanes - 1) / lanes; }
  /// Elements in whole tiles.
  int padded() const { return (count + kGroup - 1) / kGroup * kGroup; }

  /// Where entry k of element e lies in tiles of `width` entries.
  static int tile_place(int e, int k, int width) { return (e / kGroup * width + k) * kGroup + e % kGroup; }

  /// Static data, a row an element, as kernels/shared/lane_memory.h reads tiles. The last row fills up the last tile.
  template <typename Derived>
  Eigen::Matrix<typename Derived::Scalar, Eigen::Dynamic, 1> tiles(const Eigen::DenseBase<Derived>& rows) const {
    const int width = static_cast<int>(rows.cols());
    Eigen::Matrix<typename Derived::Scalar, Eigen::Dynamic, 1> tiled(padded() * width);
    for (int e = 0; e < padded(); ++e) {
      for (int k = 0; k < width; ++k) tiled[tile_place(e, k, width)] = rows(std::min(e, count - 1), k);
    }
    return tiled;
  }
};

}  // namespace swage
