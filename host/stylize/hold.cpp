// What is held.
#include <utility>

#include "plan.h"

namespace swage {

HeldPoints points_held(const StylizePlan& plan, const Gesture& handles) {
  std::vector<Hold> holds = holds_of(handles);
  if (plan.given) holds = plan.given->into(holds);
  holds = in_box(std::move(holds), plan.box);
  std::vector<char> is_held(plan.anchors.size(), 0);
  for (const Hold& hold : holds) {
    is_held[static_cast<size_t>(plan.component[static_cast<size_t>(hold.vertex())])] = 1;
  }
  for (size_t c = 0; c < is_held.size(); ++c) {
    const int anchor = plan.anchors[c];
    if (is_held[c] == 0) holds.push_back(Hold::at(anchor, plan.elements.pairs.vertices.row(anchor)));
  }
  return held_points(plan.system, holds);
}

}  // namespace swage
