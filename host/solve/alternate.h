// The only loop of the library: global step, tests, local step, until done.
#pragma once

#include <functional>

#include "swage/mesh.h"
#include "swage/report.h"

namespace swage {

struct Alternation {
  std::function<double(Positions&)> place;    ///< The global step: moves the positions and returns their energy.
  std::function<void(const Positions&)> fit;  ///< The local step: fits everything else to the positions.
};

/// Alternates from `positions` and leaves the best in them. Tests of StopRule are made between place and fit.
/// Fills stop, passes, best_pass, energy, energies and movements of the report.
Report alternate(const StopRule& stop, const ProgressFn& progress, Positions& positions, const Alternation& steps);

}  // namespace swage
