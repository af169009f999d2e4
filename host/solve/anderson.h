// Anderson acceleration: the next start of a fixed-point iteration from several passes, where a plain iteration goes
// on from the last alone.
//
// Walker, Ni: Anderson Acceleration for Fixed-Point Iterations. SIAM Journal on Numerical Analysis 49(4), 2011.
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "swage/mesh.h"

namespace swage {

class Anderson {
 public:
  /// Remembers the changes between so many passes; 0 for the plain iteration.
  explicit Anderson(int window) : window_(window) {}

  /// Where the next pass is to start, after one that led from `start` to `end`. A combined start whose pass goes
  /// farther than twice the pass before led astray: all is forgotten, and the next starts where the pass before ended.
  Positions next(const Positions& start, const Positions& end);

  std::size_t bytes() const {
    return static_cast<std::size_t>(steps_.size() + ends_.size() + last_step_.size() + last_end_.size()) *
           sizeof(double);
  }

 private:
  void remember(const Eigen::VectorXd& step, const Eigen::VectorXd& end);
  Eigen::VectorXd combined(const Eigen::VectorXd& step, const Eigen::VectorXd& end) const;

  int window_;
  bool combined_ = false;         // Whether the last start given was.
  int kept_ = 0, oldest_ = 0;     // Columns in use, and the one to go next.
  Eigen::MatrixXd steps_, ends_;  // Changes of a pass's step and of its end from the pass before.
  Eigen::MatrixXd products_;      // Of the columns of steps_ with each other.
  Eigen::VectorXd last_step_, last_end_;
};

}  // namespace swage
