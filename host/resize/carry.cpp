#include "carry.h"

#include "swage/error.h"

namespace swage {

Positions carry(const GridShape& shape, const AxisValues& vertices, const std::shared_ptr<const Mesh>& mesh,
                const Backend& backend) {
  if (vertices.rows() != shape.vertices().count()) {
    throw InvalidInput("carry: vertices: not a row for each vertex of the grid");
  }
  if (!mesh->positions.allFinite()) throw InvalidInput("carry: points: not finite");
  Positions carried;
  backend.carry({mesh, {}})->carry(shape, vertices, carried);
  return carried;
}

Positions carry(const GridShape& shape, const AxisValues& vertices, const PositionsRef& points) {
  return carry(shape, vertices, std::make_shared<Mesh>(Mesh{points, {}}), *cpu_backend());
}

}  // namespace swage
