#include "anderson.h"

#include <Eigen/Cholesky>
#include <algorithm>

namespace swage {
namespace {

constexpr double kAstray = 2;
constexpr double kRidge = 1e-12;  // Of the columns' squares in all: they become dependent as passes converge.

Eigen::Map<const Eigen::VectorXd> flat(const Positions& positions) { return {positions.data(), positions.size()}; }

}  // namespace

Positions Anderson::next(const Positions& start, const Positions& end) {
  if (window_ == 0) return end;
  Eigen::VectorXd next = flat(end);
  const Eigen::VectorXd step = next - flat(start);
  if (combined_ && step.norm() > kAstray * last_step_.norm()) {
    next = last_end_;
    kept_ = oldest_ = 0;
    last_step_.resize(0);
    combined_ = false;
  } else {
    combined_ = last_step_.size() != 0;
    if (combined_) {
      remember(step, next);
      next = combined(step, next);
    }
    last_step_ = step;
    last_end_ = flat(end);
  }
  return Eigen::Map<const Positions>(next.data(), end.rows(), 3);
}

void Anderson::remember(const Eigen::VectorXd& step, const Eigen::VectorXd& end) {
  if (steps_.rows() != step.size()) {
    steps_.resize(step.size(), window_);
    ends_.resize(step.size(), window_);
    products_.resize(window_, window_);
  }
  const int column = oldest_;
  oldest_ = (oldest_ + 1) % window_;
  kept_ = std::min(kept_ + 1, window_);
  steps_.col(column) = step - last_step_;
  ends_.col(column) = end - last_end_;
  products_.col(column).head(kept_) = steps_.leftCols(kept_).transpose() * steps_.col(column);
  products_.row(column).head(kept_) = products_.col(column).head(kept_).transpose();
}

/// The end less that mix of the changes of ends whose changes of steps take most of the step away.
Eigen::VectorXd Anderson::combined(const Eigen::VectorXd& step, const Eigen::VectorXd& end) const {
  Eigen::MatrixXd products = products_.topLeftCorner(kept_, kept_);
  const double square = products.trace();
  if (!(square > 0)) return end;
  products.diagonal().array() += kRidge * square;
  const Eigen::VectorXd mix = products.ldlt().solve(steps_.leftCols(kept_).transpose() * step);
  return end - ends_.leftCols(kept_) * mix;
}

}  // namespace swage
