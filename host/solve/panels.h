// A Cholesky factor laid out for solves that are made over and over: they read all of the factor, so what they take is
// the time to read it. In single precision, half the bytes are half the time; what rounding leaves, the caller takes
// away by another solve for the residual. In double precision, x, y and z share one reading.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace swage {

/// The factor as a supernodal factorisation leaves it.
struct Supernodes {
  std::vector<int> order;          ///< The unknown of each column.
  std::vector<int> columns;        ///< #P + 1: first column of each panel.
  std::vector<int> row_offsets;    ///< #P + 1, into rows.
  std::vector<int> rows;           ///< Ascending; a panel's own columns come first.
  std::vector<int> value_offsets;  ///< #P + 1, into values: column-major, of all rows.
  const double* values = nullptr;
};

/// Dense panels of columns that share their rows, for `kSides` right-hand sides at once. The elimination tree is cut
/// into branches for several threads and the trunk that they meet in; the cut does not depend on the number of threads,
/// and so neither do the bytes.
template <typename Scalar, int kSides>
class Panels {
 public:
  /// A row an unknown.
  using Sides = Eigen::Matrix<double, Eigen::Dynamic, kSides, kSides == 1 ? Eigen::ColMajor : Eigen::RowMajor>;

  explicit Panels(const Supernodes& source);

  /// Right-hand sides become, but for rounding, their solutions. May be called from several threads.
  void solve(Eigen::Ref<Sides> sides) const;

  std::size_t bytes() const { return values_.size() * sizeof(Scalar) + rows_.size() * sizeof(int); }

 private:
  struct Panel {
    int first, columns, below;  // The rows below its columns: `inside` of its own branch, then those of the trunk.
    int inside;
    std::ptrdiff_t rows, values;
  };
  using Rows = Eigen::Matrix<Scalar, Eigen::Dynamic, kSides, kSides == 1 ? Eigen::ColMajor : Eigen::RowMajor>;
  using Work = Eigen::Matrix<Scalar, Eigen::Dynamic, kSides>;  // By columns: rows of a panel go in step.

  /// Each of the source's columns' place here.
  std::vector<int> cut(const Supernodes& source);
  void copy(const Supernodes& source, const std::vector<int>& place);
  void forward(const Panel& panel, Rows& x, Rows* trunk, Work& work) const;
  void backward(const Panel& panel, Rows& x, Work& work) const;

  std::vector<int> order_;        // Panels of the source: branch after branch, then the trunk's.
  std::vector<int> branch_ends_;  // In order_.
  std::vector<int> place_;        // Unknown → column.
  std::vector<Panel> panels_;     // In the order of order_.
  std::vector<int> rows_;
  std::vector<Scalar> values_;
  int trunk_ = 0;  // Its first column.
  int most_rows_ = 0;
};

using SinglePanels = Panels<float, 1>;
using AxisPanels = Panels<double, 3>;

}  // namespace swage
