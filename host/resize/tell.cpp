// What a target could not be given, in words.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "plan.h"

namespace swage {
namespace {

using Eigen::Index;

constexpr double kProtected = 0.5;  // Vulnerability from which a cell counts as protected here.
constexpr double kKept = 0.02;      // Size is kept up to this.

std::string rounded(double value) {
  std::array<char, 32> text = {};
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return text.data();
}

/// Of the cells protected along an axis.
struct Protected {
  double longest = 0;                 ///< The most of a row that they take up.
  double least = INFINITY, most = 0;  ///< Scales.
};

Protected protected_along(const GridShape& shape, const CellMap& map, const AxisValues& scales, int u) {
  Protected found;
  const Index stride = shape.cells.stride(u), rows = shape.cells.count() / shape.cells[u];
  for (Index row = 0; row < rows; ++row) {
    const Index first = row / stride * stride * shape.cells[u] + row % stride;
    int count = 0;
    for (Index i = 0; i < shape.cells[u]; ++i) {
      const Index c = first + i * stride;
      if (map.theta(c, u) < kProtected) continue;
      ++count;
      found.least = std::min(found.least, scales(c, u));
      found.most = std::max(found.most, scales(c, u));
    }
    found.longest = std::max(found.longest, static_cast<double>(count) / shape.cells[u]);
  }
  return found;
}

void tell_kept_size(const ResizePlan& plan, ResizeResult& result) {
  for (int u = 0; u < 3; ++u) {
    if (!plan.shape.extends(u) || result.factors[u] == 1) continue;
    const Protected found = protected_along(plan.shape, plan.map, result.scales, u);
    if (found.longest == 0 || (found.least >= 1 - kKept && found.most <= 1 + kKept)) continue;
    const std::string along = std::string("along ") + "xyz"[u] + " ";
    std::string why = "there is little room beside them; release some of them, or give --keep size more weight";
    if (found.longest > result.factors[u]) {
      why = "they take up " + rounded(found.longest) + " of the box where they are longest, and " +
            rounded(result.factors[u]) + " is asked for; ask for more, or release some of them";
    } else if (found.longest == 1) {
      why = "they reach from end to end; release some of them";
    }
    result.report.warnings.push_back(along + "not all that is vulnerable keeps its size, scales are between " +
                                     rounded(found.least) + " and " + rounded(found.most) + ": " + why);
  }
}

}  // namespace

void tell(const ResizePlan& plan, const ResizeTarget& target, ResizeResult& result) {
  for (int u = 0; u < 3; ++u) {
    if (plan.shape.extends(u) || target.factors[u] == 1) continue;
    result.report.warnings.push_back(std::string("the model has no extent along ") + "xyz"[u] +
                                     ": the factor there changes nothing");
  }
  if (result.report.stop == Termination::cancelled) return;
  if (result.report.stop == Termination::pass_limit) {
    result.report.warnings.push_back(
        "the grid's solves did not reach the tolerance: the result is valid, but not best");
  }
  if (target.keep == ResizeKeep::size) tell_kept_size(plan, result);
}

}  // namespace swage
