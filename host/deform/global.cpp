// The vertices for the matrices: a sparse system, the same for x, y and z.
#include "block_system.h"
#include "plan.h"
#include "swage/error.h"

namespace swage {

std::shared_ptr<const HeldLaplacian> held_laplacian(DeformPlan& plan, const HeldPoints& points) {
  try {
    return plan.last_held.get(plan.system, points);
  } catch (const Indefinite& singular) {
    const int vertex = singular.element();
    const bool is_given = vertex < plan.mesh.positions.rows();
    const int told = is_given && plan.given ? plan.given->vertex(vertex) : vertex;
    throw Unsolvable("Deform: the system is singular near vertex " + std::to_string(told) +
                     ": its triangles are too badly shaped, or nothing holds them; remesh, or add a handle there");
  }
}

}  // namespace swage
