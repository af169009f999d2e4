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

#include "aggregation.h"
#include "block_system.h"
#include "cancel.h"
#include "gradients.h"
#include "pool.h"

namespace swage {

struct Level;
struct MultilevelWork;

class Multilevel {
 public:
  /// Polls between stages. Throws Unsolvable where the coarsest level is not positive definite.
  explicit Multilevel(const ElementGraph& graph, const Poll& poll = {});
  ~Multilevel();
  Multilevel(Multilevel&&) noexcept;
  Multilevel& operator=(Multilevel&&) noexcept;

  /// The same pairs with other values. Elements stay merged as they are. Not while another thread solves.
  void refill(const ElementGraph& graph, const Poll& poll = {});

  /// About the solution of the graph's system: conjugate gradients in single precision, preconditioned by one cycle
  /// through the levels, leave `tolerance` of the error. May be called from several threads.
  Gradients solve(const Eigen::VectorXd& right_hand_side, double tolerance, int limit, Eigen::VectorXd& solution,
                  const Poll& poll = {}) const;

  using TimesMatrix = std::function<void(const Eigen::VectorXd&, Eigen::VectorXd&)>;
  /// The same in double precision for a matrix that the graph's stands for, from a guess at the solution.
  Gradients improve(const TimesMatrix& times_matrix, const Eigen::VectorXd& right_hand_side, double tolerance,
                    int limit, Eigen::VectorXd& solution, const Poll& poll = {}) const;

  int levels() const;
  std::size_t bytes() const;

 private:
  template <typename Work>
  Gradients by_cycles(const Poll& poll, const Work& work) const;

  std::vector<std::unique_ptr<Level>> levels_;           // The finest first.
  std::vector<std::vector<std::pair<int, int>>> pairs_;  // Of each level but the finest.
  std::optional<BlockSystem> coarsest_;
  std::unique_ptr<Pool<MultilevelWork>> works_;  // Fresh memory costs a tenth of a solve.
};

}  // namespace swage
