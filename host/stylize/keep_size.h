// The size of what scales freely.
#pragma once

#include <vector>

#include "plan.h"

namespace swage {

/// Keeps the mean square of each component's scales, by sum w |e0|², at 1: else the objective of acap is least where
/// all has shrunk to a point. Handles at several places give a size themselves, but no smaller one, in this mean, than
/// they draw their own mean square distance to. Where scales of least energy break such a bound, those of least energy
/// within it are these times one factor.
class KeepSize {
 public:
  /// Where elements are vertices.
  KeepSize(const StylizePlan& plan, const HeldPoints& points);
  void of(const StylizePlan& plan, StylizeFit& fitted) const;

 private:
  Eigen::VectorXd weights_;  // #N
  Eigen::VectorXd least_;    // Of each component the sum of weight and squared scale.
  std::vector<char> grows_;  // Whether it may be more.
};

}  // namespace swage
