#include "alternate.h"

#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "swage/error.h"

namespace swage {
namespace {

double largest_movement(const Positions& before, const Positions& after) {
  return (after - before).rowwise().norm().maxCoeff();
}

bool goes_on(const ProgressFn& progress, const StopRule& stop, const Report& report) {
  if (!progress) return true;
  const double fraction = static_cast<double>(report.passes) / stop.pass_limit;
  return progress({"pass", report.passes, stop.pass_limit, fraction, report.energy});
}

/// The tests in their published order: which one fires is part of the result.
std::optional<Termination> ended(const StopRule& stop, const Report& report) {
  const size_t n = report.energies.size();
  if (report.passes >= stop.first_test && n >= 2) {
    const double drop = report.energies[n - 2] - report.energies[n - 1];
    if (stop.by_energy && drop <= 0) return Termination::energy_rose;
    if (stop.by_energy && drop < stop.energy_drop) return Termination::energy_settled;
    if (report.movements.back() < stop.movement) return Termination::moved_little;
  }
  if (report.passes >= stop.pass_limit) return Termination::pass_limit;
  return std::nullopt;
}

}  // namespace

Report alternate(const StopRule& stop, const ProgressFn& progress, Positions& positions, const Alternation& steps) {
  Report report;
  const auto asked = [&] { return goes_on(progress, stop, report); };
  const Poll poll = sparing(asked);
  Positions start = positions, last;
  try {
    for (;;) {
      if (!asked()) throw Cancelled();
      Positions placed = start;
      const double energy = steps.place(placed, poll);
      if (!std::isfinite(energy)) {
        throw Unsolvable("alternate: the energy of pass " + std::to_string(report.passes) +
                         " is not finite; look for triangles badly shaped, or remesh");
      }
      last = std::exchange(positions, std::move(placed));
      report.energy = energy;
      report.best_pass = report.passes++;
      report.energies.push_back(energy);
      report.movements.push_back(largest_movement(start, positions));
      std::optional<Termination> end = ended(stop, report);
      if (steps.moved_little && steps.moved_little(start, positions)) end = Termination::moved_little;
      if (end) {
        report.stop = *end;
        break;
      }
      start = steps.next ? steps.next(start, positions, poll) : positions;
      steps.fit(start, poll);
    }
  } catch (const Cancelled&) {
    report.stop = Termination::cancelled;
  }
  if (report.stop == Termination::energy_rose) {
    positions = last;
    report.best_pass -= 1;
    report.energy = report.energies[report.energies.size() - 2];
  }
  return report;
}

}  // namespace swage
