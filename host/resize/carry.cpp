#include "carry.h"

#include "messages.h"
#include "swage/error.h"

namespace swage {

Positions carry(const GridShape& shape, const AxisValues& vertices, const std::shared_ptr<const Mesh>& mesh,
                const Backend& backend) {
  if (vertices.rows() != shape.vertices().count()) {
    throw InvalidInput("carry: vertices: " + std::to_string(vertices.rows()) + " rows, but the grid has " +
                       std::to_string(shape.vertices().count()) + " vertices; give one for each");
  }
  if (const Eigen::Index row = first_not_finite(mesh->positions); row >= 0) {
    throw InvalidInput("carry: points: row " + std::to_string(row) + " is not finite; mend it");
  }
  Positions carried;
  backend.carry({mesh, {}})->carry(shape, vertices, carried);
  return carried;
}

Positions carry(const GridShape& shape, const AxisValues& vertices, const PositionsRef& points) {
  return carry(shape, vertices, std::make_shared<Mesh>(Mesh{points, {}}), *cpu_backend());
}

}  // namespace swage
