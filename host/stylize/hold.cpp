// What is held.
#include <utility>

#include "plan.h"

namespace swage {

StylizeHolds holds_for(const StylizePlan& plan, const Gesture& handles) {
  std::vector<Hold> holds = holds_of(handles);
  if (plan.given) holds = plan.given->into(holds);
  holds = in_box(std::move(holds), plan.box);
  std::vector<std::optional<int>> held(plan.anchors.size());  // A vertex.
  std::vector<char> has_size(plan.anchors.size(), 0);
  for (const Hold& hold : holds) {
    const auto c = static_cast<size_t>(plan.component[static_cast<size_t>(hold.vertex())]);
    if (held[c] && *held[c] != hold.vertex()) has_size[c] = 1;
    held[c] = hold.vertex();
  }
  for (size_t c = 0; c < held.size(); ++c) {
    const int anchor = plan.anchors[c];
    if (!held[c]) holds.push_back(Hold::at(anchor, plan.elements.pairs.vertices.row(anchor)));
  }
  return {held_points(plan.system, holds), has_size};
}

}  // namespace swage
