// What is refused.
#include <cmath>
#include <cstdint>
#include <string>

#include "messages.h"
#include "plan.h"
#include "swage/error.h"
#include "vulnerability.h"

namespace swage {
namespace {

constexpr int kMostAlongAxis = 1000;
constexpr std::int64_t kMostCells = 10'000'000;

[[noreturn]] void refuse(const std::string& what) { throw InvalidInput("Resize: " + what); }

void check_cells(const std::array<int, 3>& cells) {
  for (const int count : cells) {
    if (count < 0 || count > kMostAlongAxis) {
      refuse("options.cells: " + std::to_string(count) + " is not between 0 and " + std::to_string(kMostAlongAxis));
    }
  }
}

}  // namespace

void check_options(const PositionsRef& positions, const ResizeOptions& options) {
  check_options("Resize: options.vulnerability", options.vulnerability);
  check_cells(options.cells);
  if (options.longest < kFewestCells || options.longest > kMostAlongAxis) {
    refuse("options.longest: " + std::to_string(options.longest) + " is not between " + std::to_string(kFewestCells) +
           " and " + std::to_string(kMostAlongAxis));
  }
  if (!(options.tolerance > 0 && options.tolerance < 1))
    refuse("options.tolerance: " + digits(options.tolerance) + " is not in (0, 1)");
  if (box_diagonal(positions) == 0) refuse("positions: all vertices are at one place; there is nothing to resize");
  const GridShape shape = shape_of(positions, options);
  if (shape.cells.count() > kMostCells) {
    refuse("options.cells: " + std::to_string(shape.cells[0]) + " x " + std::to_string(shape.cells[1]) + " x " +
           std::to_string(shape.cells[2]) + " cells are more than 10 million; ask for fewer");
  }
}

void check_target(const GridShape& shape, const ResizeTarget& target) {
  check_factors("Resize: target", shape, target.factors);
  if (!(target.size_weight > 0 && std::isfinite(target.size_weight))) {
    refuse("target.size_weight: " + digits(target.size_weight) + " is not finite and above 0");
  }
}

}  // namespace swage
