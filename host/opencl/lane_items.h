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
  Eigen::Index padded() const { return (Eigen::Index{count} + kGroup - 1) / kGroup * kGroup; }

  /// Where entry k of element e lies in tiles of `width` entries.
  static Eigen::Index tile_place(Eigen::Index e, Eigen::Index k, Eigen::Index width) {
    return (e / kGroup * width + k) * kGroup + e % kGroup;
  }

  /// Static data, a row an element, as kernels/shared/lane_memory.h reads tiles. The last row fills up the last tile.
  template <typename Derived>
  Eigen::Matrix<typename Derived::Scalar, Eigen::Dynamic, 1> tiles(const Eigen::DenseBase<Derived>& rows) const {
    const Eigen::Index width = rows.cols();
    Eigen::Matrix<typename Derived::Scalar, Eigen::Dynamic, 1> tiled(padded() * width);
    for (Eigen::Index e = 0; e < padded(); ++e) {
      const Eigen::Index present = std::min<Eigen::Index>(e, count - 1);
      for (Eigen::Index k = 0; k < width; ++k) tiled[tile_place(e, k, width)] = rows(present, k);
    }
    return tiled;
  }
};

}  // namespace swage
