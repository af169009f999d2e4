// The only loop of the library: global step, tests, local step, until done.
#pragma once

#include <functional>

#include "cancel.h"
#include "swage/mesh.h"
#include "swage/report.h"

namespace swage {

struct Alternation {
  /// The global step: moves the positions and returns their energy.
  std::function<double(Positions&, const Poll&)> place;
  /// The local step: fits everything else to the positions.
  std::function<void(const Positions&, const Poll&)> fit;
  /// Where the next pass starts, after one that led from the first positions to the second; else where that ended.
  std::function<Positions(const Positions&, const Positions&, const Poll&)> next = {};
  /// Whether a pass that led from the first positions to the second moved little, beside StopRule::movement.
  std::function<bool(const Positions&, const Positions&)> moved_little = {};
};

/// Alternates from `positions` and leaves the best in them. Tests of StopRule are made between place and fit. A pass's
/// movement is how far it moves a vertex from where the pass started. Where `progress` cancels, between passes or when
/// a step polls, the positions are the last complete pass's.
/// Fills stop, passes, best_pass, energy, energies and movements of the report.
Report alternate(const StopRule& stop, const ProgressFn& progress, Positions& positions, const Alternation& steps);

}  // namespace swage
