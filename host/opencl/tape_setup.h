// What a tape makes of its parameters, before any point.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "swage/tape.h"

namespace swage {

struct TapeSetup {
  /// Derivatives only where asked for.
  TapeSetup(const Tape& tape, const Eigen::VectorXd& parameters, bool with_derivatives);

  Eigen::VectorXd values;  ///< Of the uniform slots.
  /// By parameter m those slots change that stand at offsets[m] .. offsets[m + 1], by as much as `weights` say.
  std::vector<int> offsets, slots;
  Eigen::VectorXd weights;
};

}  // namespace swage
