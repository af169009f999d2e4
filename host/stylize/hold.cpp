// What is held.
#include <utility>

#include "plan.h"

namespace swage {

namespace {

std::vector<Hold> holds_in_box(const StylizePlan& plan, const Gesture& handles) {
  std::vector<Hold> holds = holds_of(handles);
  if (plan.given) holds = plan.given->into(holds);
  return in_box(std::move(holds), plan.box);
}

std::vector<char> components_of(const StylizePlan& plan, const std::vector<Hold>& holds) {
  std::vector<char> has_any(plan.anchors.size(), 0);
  for (const Hold& hold : holds) {
    has_any[static_cast<size_t>(plan.component[static_cast<size_t>(hold.vertex())])] = 1;
  }
  return has_any;
}

}  // namespace

std::vector<char> held_components(const StylizePlan& plan, const Gesture& handles) {
  return components_of(plan, holds_in_box(plan, handles));
}

HeldPoints points_held(const StylizePlan& plan, const Gesture& handles) {
  std::vector<Hold> holds = holds_in_box(plan, handles);
  const std::vector<char> is_held = components_of(plan, holds);
  for (size_t c = 0; c < is_held.size(); ++c) {
    const int anchor = plan.anchors[c];
    if (is_held[c] == 0) holds.push_back(Hold::at(anchor, plan.elements.pairs.vertices.row(anchor)));
  }
  return held_points(plan.system, holds);
}

}  // namespace swage
