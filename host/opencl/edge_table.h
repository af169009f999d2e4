// What lies beside each edge, as kernels/transform.cl reads it.
#pragma once

#include <vector>

#include "swage/steps.h"

namespace swage {

struct EdgeTable {
  using Rest = Eigen::Matrix<double, Eigen::Dynamic, 8, Eigen::RowMajor>;
  using Ints2 = Eigen::Matrix<int, Eigen::Dynamic, 2, Eigen::RowMajor>;

  /// #E × 2 triangles: the two that are a pair, or one twice.
  Ints2 beside;
  /// #E: vector; of the pair: unit vector between the opposite vertices, similarity weight; kept target length or 0.
  Rest rest;

  /// The few edges of which `beside` does not tell all, and their triangles at offsets[i] .. offsets[i + 1].
  std::vector<int> crowded, offsets, triangles;
  /// The pairs of triangles that are not in `beside`, and their edge, as `rest` has it.
  Ints2 pairs;
  Rest pair_rest;

  /// #T × 12: vectors of a triangle's edges, the way round it, and 1 over how many triangles each has.
  Eigen::Matrix<double, Eigen::Dynamic, 12, Eigen::RowMajor> of_triangles;
  /// #E: 3 t + k, a triangle t whose k-th edge it is.
  Eigen::VectorXi first_corners;
};

EdgeTable edge_table(const TransformStep::Rest& rest);

}  // namespace swage
