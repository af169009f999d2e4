// What a target could not be given, in words.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "plan.h"

namespace swage {
namespace {

using Eigen::Index;

constexpr double kKept = 0.05;    // Size is kept up to this,
constexpr double kMissed = 0.05;  // and told of where more than this part of the protected cells do not keep it.

std::string rounded(double value) {
  std::array<char, 32> text = {};
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return text.data();
}

/// Of the cells protected along an axis.
struct Protected {
  double longest = 0;                 ///< The most of a row that they take up.
  double count = 0, changed = 0;      ///< All, and those that do not keep their size.
  double least = INFINITY, most = 0;  ///< Their scales.
};

Protected protected_along(const GridShape& shape, const AxisValues& theta, const AxisValues& scales, int u) {
  Protected found;
  const Index stride = shape.cells.stride(u), rows = shape.cells.count() / shape.cells[u];
  for (Index row = 0; row < rows; ++row) {
    const Index first = row / stride * stride * shape.cells[u] + row % stride;
    double count = 0;
    for (Index i = 0; i < shape.cells[u]; ++i) {
      const Index c = first + i * stride;
      if (theta(c, u) < kProtected) continue;
      count += 1;
      found.changed += std::abs(scales(c, u) - 1) > kKept ? 1 : 0;
      found.least = std::min(found.least, scales(c, u));
      found.most = std::max(found.most, scales(c, u));
    }
    found.count += count;
    found.longest = std::max(found.longest, count / shape.cells[u]);
  }
  return found;
}

/// Where it reaches farther than the new box.
std::string too_long(const Protected& found, double factor) {
  return "where it is longest it takes up " + rounded(found.longest) + " of the box, and " + rounded(factor) +
         " is asked for";
}

std::string along(int u) { return std::string("along ") + "xyz"[u] + ", "; }

std::string scales_of(const Protected& found) {
  return " (scales from " + rounded(found.least) + " to " + rounded(found.most) + ")";
}

void tell_kept_size(const ResizePlan& plan, ResizeResult& result) {
  for (int u = 0; u < 3; ++u) {
    if (!plan.shape.extends(u)) continue;
    const Protected found = protected_along(plan.shape, plan.map.theta, result.scales, u);
    if (found.changed <= kMissed * found.count) continue;
    std::string why = "there is too little room beside it";
    std::string remedy = "release some of it, or keep its size with more weight";
    if (found.longest > result.factors[u]) {
      why = too_long(found, result.factors[u]);
      remedy = "ask for more, or release some of it";
    } else if (found.longest == 1 && result.factors[u] != 1) {
      why = "it reaches from end to end";
      remedy = "release some of it";
    }
    result.report.warnings.push_back(along(u) + rounded(100 * found.changed / found.count) +
                                     " % of what is vulnerable does not keep its size" + scales_of(found) + ": " + why +
                                     "; " + remedy);
  }
}

/// Of shapes that are kept only what the user protects: that other parts shrink is how the method makes room.
void tell_kept_shape(const ResizePlan& plan, ResizeResult& result) {
  for (int u = 0; u < 3; ++u) {
    if (!plan.shape.extends(u)) continue;
    const Protected found = protected_along(plan.shape, plan.said, result.scales, u);
    if (found.count == 0 || found.longest <= result.factors[u]) continue;
    result.report.warnings.push_back(along(u) + "what is protected is larger than the new size, and shrinks" +
                                     scales_of(found) + ": " + too_long(found, result.factors[u]) +
                                     "; ask for more, or release some of it");
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
  target.keep == ResizeKeep::size ? tell_kept_size(plan, result) : tell_kept_shape(plan, result);
}

}  // namespace swage
