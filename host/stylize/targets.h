// Where normals are to point.
#pragma once

#include <functional>

#include "plan.h"

namespace swage {

struct Targets {
  /// #N × 3, unit or zero, for positions in the unit box.
  std::function<Positions(const Positions&)> find;
  bool dynamic = false;  ///< Whether they are found again after each pass.
};

/// Borrows the plan and the style. For one thread.
Targets targets_of(const StylizePlan& plan, const Style& style);

/// Of the mesh as given.
GivenNormals as_given(const StylizePlan& plan, const Positions& targets);

/// How much normals around vertices spread in the second direction, of all three, mean over the surface at rest. It
/// falls with the square of the triangles' size.
double mean_second_spread(const StylizePlan& plan, NormalFitStep& step);

/// Of triangles (paper appendix E). Where the second spread is a smaller part than `least_part`, the normals around a
/// vertex are to be one; the style's threshold, where it has one, in place of that.
Positions developable_normals(const StylizePlan& plan, NormalFitStep& step, const Developable& style, double least_part,
                              const Positions& positions);

}  // namespace swage
