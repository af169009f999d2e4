// A Cholesky factor in single precision, for solves that are made over and over: they read all of the factor, so half
// the bytes are half the time. What rounding leaves, the caller takes away by another solve for the residual.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace swage {

/// Dense panels of columns that share their rows. The elimination tree is cut into branches for several threads and the
/// trunk that they meet in; the cut does not depend on the number of threads, and so neither do the bytes.
class Panels {
 public:
  /// The factor as a supernodal factorisation leaves it.
  struct Source {
    std::vector<int> order;          ///< The unknown of each column.
    std::vector<int> columns;        ///< #P + 1: first column of each panel.
    std::vector<int> row_offsets;    ///< #P + 1, into rows.
    std::vector<int> rows;           ///< Ascending; a panel's own columns come first.
    std::vector<int> value_offsets;  ///< #P + 1, into values: column-major, of all rows.
    const double* values = nullptr;
  };

  explicit Panels(const Source& source);

  /// A right-hand side becomes, but for rounding, its solution. May be called from several threads.
  void solve(Eigen::Ref<Eigen::VectorXd> column) const;

  std::size_t bytes() const { return values_.size() * sizeof(float) + rows_.size() * sizeof(int); }

 private:
  struct Panel {
    int first, columns, below;  // The rows below its columns: `inside` of its own branch, then those of the trunk.
    int inside;
    std::ptrdiff_t rows, values;
  };
  using Column = Eigen::Map<const Eigen::VectorXf>;

  /// Each of the source's columns' place here.
  std::vector<int> cut(const Source& source);
  void copy(const Source& source, const std::vector<int>& place);
  float diagonal(const Panel& panel, int column) const;
  Column below_diagonal(const Panel& panel, int column) const;
  void forward(const Panel& panel, Eigen::VectorXf& x, float* trunk, Eigen::VectorXf& work) const;
  void backward(const Panel& panel, Eigen::VectorXf& x, Eigen::VectorXf& work) const;

  std::vector<int> order_;        // Panels of the source: branch after branch, then the trunk's.
  std::vector<int> branch_ends_;  // In order_.
  std::vector<int> place_;        // Unknown → column.
  std::vector<Panel> panels_;     // In the order of order_.
  std::vector<int> rows_;
  std::vector<float> values_;
  int trunk_ = 0;  // Its first column.
  int most_rows_ = 0;
};

}  // namespace swage
