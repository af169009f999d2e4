// What is held.
#include "block_system.h"
#include "plan.h"
#include "swage/error.h"

namespace swage {

HeldPoints points_held(const StylizePlan& plan, const Gesture& handles) {
  std::vector<Hold> holds = holds_of(handles);
  if (plan.given) holds = plan.given->into(holds);
  std::vector<char> is_held(plan.anchors.size(), 0);
  for (Hold& hold : holds) {
    hold.target = (hold.target - plan.box.corner) / plan.box.extent;
    is_held[static_cast<size_t>(plan.component[static_cast<size_t>(hold.vertex())])] = 1;
  }
  for (size_t c = 0; c < is_held.size(); ++c) {
    const int anchor = plan.anchors[c];
    if (is_held[c] == 0) holds.push_back(Hold::at(anchor, plan.elements.pairs.vertices.row(anchor)));
  }
  return held_points(plan.system, holds);
}

std::shared_ptr<const HeldLaplacian> held_laplacian(StylizePlan& plan, const HeldPoints& points) {
  try {
    return plan.last_held.get(plan.system, points);
  } catch (const Indefinite& singular) {
    const int vertex = plan.given ? plan.given->vertex(singular.element()) : singular.element();
    throw Unsolvable("Stylize: the system is singular near vertex " + std::to_string(vertex) +
                     ": its triangles are too badly shaped; remesh, or add a handle there");
  }
}

}  // namespace swage
