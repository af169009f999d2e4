#include "step_inputs.h"

#include <utility>

#include "plan.h"
#include "shapes.h"

namespace swage::bench {

Mesh mesh_of(int triangles) {
  const int around = triangles == 10'000 ? 100 : triangles == 100'000 ? 250 : 1000;
  return test::torus(1, 0.4, around, triangles / 2 / around);
}

TransformStep::Rest reshape_rest(int triangles) {
  const Mesh mesh = mesh_of(triangles);
  return rest_shape({}, mesh, edges_of(mesh.triangles), Curvatures::Zero(mesh.triangles.rows(), 2));
}

CurvatureStep::Rest curvature_rest(int vertices) {
  const Mesh mesh = test::torus(1, 0.4, vertices / 100, 100);
  const Lists near = one_rings(edges_of(mesh.triangles), vertices);
  CurvatureStep::Rest rest{mesh.positions, mesh.positions, {0}, {}};
  for (auto normal : rest.normals.rowwise()) {
    const Eigen::RowVector3d flat(normal.x(), normal.y(), 0);
    normal = (normal - flat.normalized()).normalized().eval();
  }
  std::vector<int> seen_from(static_cast<size_t>(vertices), -1);
  for (int v = 0; v < vertices; ++v) {
    const size_t first = rest.neighbours.size();
    seen_from[static_cast<size_t>(v)] = v;
    auto add_around = [&](int of) {
      for (const int neighbour : near[of]) {
        if (std::exchange(seen_from[static_cast<size_t>(neighbour)], v) != v) rest.neighbours.push_back(neighbour);
      }
    };
    add_around(v);
    for (int ring = 1; ring < 3; ++ring) {
      const size_t known = rest.neighbours.size();
      for (size_t k = first; k < known; ++k) add_around(rest.neighbours[k]);
    }
    rest.offsets.push_back(static_cast<int>(rest.neighbours.size()));
  }
  return rest;
}

}  // namespace swage::bench
