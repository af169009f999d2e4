#include "alternate.h"

#include <cmath>
#include <optional>
#include <string>

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
  Positions start = positions, last;
  for (;;) {
    if (!goes_on(progress, stop, report)) {
      report.stop = Termination::cancelled;
      break;
    }
    last = positions;
    positions = start;
    report.energy = steps.place(positions);
    if (!std::isfinite(report.energy)) {
      throw Unsolvable("alternate: the energy of pass " + std::to_string(report.passes) + " is not finite");
    }
    ++report.passes;
    report.best_pass = report.passes - 1;
    report.energies.push_back(report.energy);
    report.movements.push_back(largest_movement(start, positions));
    if (const std::optional<Termination> end = ended(stop, report)) {
      report.stop = *end;
      break;
    }
    start = steps.next ? steps.next(start, positions) : positions;
    steps.fit(start);
  }
  if (report.stop == Termination::energy_rose) {
    positions = last;
    report.best_pass -= 1;
    report.energy = report.energies[report.energies.size() - 2];
  }
  return report;
}

}  // namespace swage
