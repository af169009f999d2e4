#include "calls.h"
#include "swage/deform.h"
#include "swage/reshape.h"

namespace swage::test {
namespace {

ReshapeOptions weighing(double ReshapeWeights::*weight, double value) {
  ReshapeWeights weights;
  weights.*weight = value;
  return with(&ReshapeOptions::weights, weights);
}

ReshapeOptions published(LinearSolver solver, When remesh) {
  ReshapeOptions options = with(&ReshapeOptions::solver, ReshapeSolver::published);
  options.linear_solver = solver;
  options.remesh = remesh;
  return options;
}

/// Of a mesh of so many vertices and triangles.
ReshapeResult start(Eigen::Index vertices, Eigen::Index triangles, double last = 1) {
  ReshapeResult result;
  result.unfinished = rows(vertices, 1, last);
  result.transforms = Transforms::Ones(triangles, 9);
  return result;
}

Reshape reshape_of(const Mesh& mesh, const ReshapeOptions& options = {}) {
  return {mesh.positions, mesh.triangles, options};
}

Deform deform_of(const Mesh& mesh, const DeformOptions& options = {}) {
  return {mesh.positions, mesh.triangles, options};
}

DeformOptions with_handle_weight(double weight) { return with(&DeformOptions::handle_weight, weight); }

}  // namespace

std::vector<Call> edit_calls() {
  return {
      CALL(reshape_of(point)),
      CALL(reshape_of(line)),
      CALL(reshape_of(cube, weighing(&ReshapeWeights::normal, -1))),
      CALL(reshape_of(cube, weighing(&ReshapeWeights::handle, 0))),
      CALL(reshape_of(cube, with(&ReshapeOptions::feature_angle, nan))),
      CALL(reshape_of(cube, with(&ReshapeOptions::pass_limit, 0))),
      CALL(reshape_of(cube, with(&ReshapeOptions::movement, 0))),
      CALL(reshape_of(cube, with(&ReshapeOptions::stand_in_triangles, 99))),
      CALL(reshape_of(cube, with(&ReshapeOptions::acceleration_window, 51))),
      CALL(reshape_of(cube, published(LinearSolver::multigrid, When::never))),
      CALL(reshape_of(cube, published(LinearSolver::automatic, When::always))),
      CALL(reshape_of(cube, with(&ReshapeOptions::unit_box_curvatures, Curvatures::Zero(8, 2)))),
      CALL(reshape_of(cube, with(&ReshapeOptions::unit_box_curvatures, Curvatures::Constant(12, 2, nan)))),
      CALL(reshape_of(cube, with(&ReshapeOptions::straight_chains, std::vector<std::vector<int>>{{0, 99}}))),
      CALL(reshape_of(cube).solve(Gesture{})),
      CALL(reshape_of(cube, published(LinearSolver::automatic, When::never)).solve(up, start(8, 12))),
      CALL(reshape_of(cube).solve(up, start(7, 12))),
      CALL(reshape_of(cube).solve(up, start(8, 11))),
      CALL(reshape_of(cube).solve(up, start(8, 12, nan))),
      CALL(deform_of(line)),
      CALL(deform_of(cube, with_handle_weight(0))),
      CALL(deform_of(cube, with(&DeformOptions::pass_limit, 0))),
      CALL(deform_of(cube, with(&DeformOptions::movement, 0))),
      CALL(deform_of(cube, with(&DeformOptions::acceleration_window, 51))),
      CALL(deform_of(cube, with(&DeformOptions::filling_time_limit, 0))),
      CALL(deform_of(cube).solve(up, DeformResult{rows(7), {}})),
      CALL(deform_of(cube).solve(up, DeformResult{rows(8, 1, nan), {}})),
  };
}

}  // namespace swage::test
