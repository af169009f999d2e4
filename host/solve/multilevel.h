// A solver for systems whose factor would not fit, or takes longer: aggregation multigrid.
//
// Notay: An aggregation-based algebraic multigrid method. Electronic Transactions on Numerical Analysis 37, 2010: the
// K-cycle, which makes plain aggregation independent of size.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "block_system.h"
#include "cancel.h"
#include "conjugate_gradients.h"

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

class Multilevel {
 public:
  /// Polls between stages. Throws Unsolvable where the coarsest level is not positive definite.
  explicit Multilevel(const ElementGraph& graph, const Poll& poll = {});
  ~Multilevel();
  Multilevel(Multilevel&&) noexcept;
  Multilevel& operator=(Multilevel&&) noexcept;

  /// The same pairs with other values. Elements stay merged as they are. Not while another thread solves.
  void refill(const ElementGraph& graph);

  /// About the solution of the graph's system: conjugate gradients in single precision, preconditioned by one cycle
  /// through the levels, leave `tolerance` of the error. May be called from several threads.
  Eigen::VectorXd solve(const Eigen::VectorXd& right_hand_side, double tolerance, int limit,
                        const Poll& poll = {}) const;

  using TimesMatrix = std::function<void(const Eigen::VectorXd&, Eigen::VectorXd&)>;
  /// The same in double precision for a matrix that the graph's stands for, from a guess at the solution.
  Gradients improve(const TimesMatrix& times_matrix, const Eigen::VectorXd& right_hand_side, double tolerance,
                    int limit, Eigen::VectorXd& solution, const Poll& poll = {}) const;

  int levels() const;
  std::size_t bytes() const;

  struct Level;

 private:
  std::vector<std::unique_ptr<Level>> levels_;           // The finest first.
  std::vector<std::vector<std::pair<int, int>>> pairs_;  // Of each level but the finest.
  std::optional<BlockSystem> coarsest_;
};

}  // namespace swage
