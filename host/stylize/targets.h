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

/// Borrows the plan and the style.
Targets targets_of(const StylizePlan& plan, const Style& style);

/// Of the mesh as given.
GivenNormals as_given(const StylizePlan& plan, const Positions& targets);

/// Of triangles (paper appendix E). Mesh units squared are those of the style's threshold.
Positions developable_normals(const StylizePlan& plan, const Developable& style, const Positions& positions);

}  // namespace swage
