// Elements on a graph, and their merging into fewer.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "cancel.h"

namespace swage {

/// Elements on a graph. The unknown of each is a matrix X of so many rows of three, and the system minimises
///   sum_elements x' own x + sum_pairs |(X_i - X_j) root|²,   root root' = coupling, x the rows of X one after the
///   other.
/// Merging elements whose X agree gives a system of the same form on fewer: its own terms and couplings are sums. So
/// each level keeps what the matrix has of structure: one coupling of six numbers for all rows.
struct ElementGraph {
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  int rows = 3;                            ///< 1 for a vertex, 3 for a triangle's transform.
  std::vector<std::pair<int, int>> pairs;  ///< Repeats allowed. An element with itself has no term.
  Eigen::Matrix<float, Eigen::Dynamic, 6, Eigen::RowMajor> couplings;  ///< Symmetric: xx, xy, xz, yy, yz, zz.
  Rows own;                                                            ///< Lower triangles, row by row.
};

using PackedCoupling = Eigen::Matrix<float, 1, 6>;
Eigen::Matrix3d unpacked(const PackedCoupling& packed);

/// For each element its neighbours, ascending, each once, with what couples them.
struct Couplings {
  std::vector<int> offsets, neighbours;
  Eigen::Matrix<float, Eigen::Dynamic, 6, Eigen::RowMajor> values;

  Eigen::Index begin(Eigen::Index element) const { return offsets[static_cast<size_t>(element)]; }
  Eigen::Index end(Eigen::Index element) const { return offsets[static_cast<size_t>(element) + 1]; }
  int neighbour(Eigen::Index k) const { return neighbours[static_cast<size_t>(k)]; }
  /// The coupling of two elements that are coupled.
  Eigen::Index find(Eigen::Index element, int other) const;
};

Couplings couplings_of(const ElementGraph& graph, const Poll& poll = {});

struct Merge {
  std::vector<int> into;  // Of each element.
  int count = 0;
};

/// Each element with that of its free neighbours which it is coupled to most strongly.
Merge pairing(const Couplings& couplings);

/// The graph of the merged elements.
ElementGraph merged(const Couplings& couplings, const ElementGraph::Rows& own, int rows, const Merge& merge);

}  // namespace swage
