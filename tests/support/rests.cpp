#include "rests.h"

#include <cmath>
#include <random>

#include "measures.h"
#include "plan.h"
#include "shapes.h"

namespace swage::test {
namespace {

/// Five triangles at one edge: more neighbours than a triangle has sides.
Mesh triangle_fan() {
  Mesh mesh{Positions(7, 3), Triangles(5, 3)};
  mesh.positions.topRows(2) << 0, 0, 0, 0, 0, 1;
  for (int i = 0; i < 5; ++i) {
    mesh.positions.row(2 + i) << std::cos(1.1 * i), std::sin(1.1 * i), 0.3 * i;
    mesh.triangles.row(i) << 0, 1, 2 + i;
  }
  return mesh;
}

Mesh stretched(Mesh mesh, const Eigen::Vector3d& factors) {
  mesh.positions = mesh.positions * factors.asDiagonal();
  return mesh;
}

/// A torus whose vertices lie anywhere.
Mesh random_shape() {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  Mesh mesh = torus();
  mesh.positions = Positions::NullaryExpr(mesh.positions.rows(), 3, [&] { return uniform(random); });
  return mesh;
}

TransformStep::Rest none() {
  TransformStep::Rest rest = rest_of({Positions::Zero(1, 3), Triangles(0, 3)});
  rest.mean_edge_length = 1;  // No edge has a mean.
  return rest;
}

}  // namespace

TransformStep::Rest rest_of(const Mesh& mesh, double curvatures, ReshapeSolver solver) {
  ReshapeOptions options;
  options.solver = solver;
  return rest_shape(options, mesh, edges_of(mesh.triangles),
                    Curvatures::Constant(mesh.triangles.rows(), 2, curvatures));
}

std::vector<std::pair<std::string, TransformStep::Rest>> rest_families() {
  const Mesh triangle{Eigen::Matrix3d{{0, 0, 0}, {1, 0, 0}, {0.3, 0.8, 0.1}}, Triangles(Eigen::RowVector3i(0, 1, 2))};
  return {{"closed", rest_of(torus())},
          {"steady", rest_of(torus(), 2, ReshapeSolver::steady)},
          {"sharp edges", rest_of(box())},
          {"none round", rest_of(box(), 0)},
          {"flat, with boundary", rest_of(sheet(20))},
          {"needles", rest_of(stretched(sheet(20), {1, 1e-3, 1}))},
          {"five triangles at an edge", rest_of(triangle_fan())},
          {"five triangles at an edge, steady", rest_of(triangle_fan(), 2, ReshapeSolver::steady)},
          {"one triangle", rest_of(triangle)},
          {"random", rest_of(random_shape())},
          {"none", none()},
          {"tiny", rest_of(transformed(box(), 1e-4, {0, 0, 0}))},
          {"huge", rest_of(transformed(box(), 1e4, {0, 0, 0}))}};
}

}  // namespace swage::test
