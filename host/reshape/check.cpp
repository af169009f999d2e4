// What cannot be reshaped is refused, in words.
#include <algorithm>
#include <cmath>
#include <string>

#include "plan.h"
#include "swage/error.h"

namespace swage {

void check_options(const ReshapeOptions& options, const Mesh& mesh) {
  const ReshapeWeights w = options.weights.value_or(ReshapeWeights());
  for (const double weight : {w.normal, w.similarity, w.connect, w.sphericity, w.scale, w.regularizer,
                              w.normal_regularizer, w.handle, w.straightness}) {
    if (!(weight >= 0) || std::isinf(weight)) throw InvalidInput("Reshape: options.weights: not finite or negative");
  }
  if (w.regularizer == 0 || w.handle == 0) {
    throw InvalidInput("Reshape: options.weights: regularizer and handle must be above 0");
  }
  if (!(options.feature_angle >= 0 && options.feature_angle <= std::numbers::pi)) {
    throw InvalidInput("Reshape: options.feature_angle: not in [0, pi] radians");
  }
  if (options.pass_limit < 1) throw InvalidInput("Reshape: options.pass_limit: below 1");
  if (!(options.movement > 0) || std::isinf(options.movement)) {
    throw InvalidInput("Reshape: options.movement: not finite and above 0");
  }
  if (options.linear_solver == LinearSolver::multigrid &&
      (options.solver == ReshapeSolver::published || options.refactor_every_pass)) {
    throw InvalidInput(
        "Reshape: options.linear_solver: the published solver and refactor_every_pass need a factor; take the steady "
        "solver for multigrid");
  }
  if (options.stand_in_triangles < 100 || options.stand_in_triangles > 1'000'000) {
    throw InvalidInput("Reshape: options.stand_in_triangles: not in [100, 1000000]");
  }
  if (options.solver == ReshapeSolver::published && options.remesh == When::always) {
    throw InvalidInput("Reshape: options.remesh: the published solver takes the mesh as it is; take the steady solver");
  }
  if (options.acceleration_window < 0 || options.acceleration_window > 50) {
    throw InvalidInput("Reshape: options.acceleration_window: not in [0, 50]");
  }
  if (!options.unit_box_curvatures) return;
  if (options.unit_box_curvatures->rows() != mesh.triangles.rows() || !options.unit_box_curvatures->allFinite()) {
    throw InvalidInput("Reshape: options.unit_box_curvatures: not a row of two finite numbers for each of the " +
                       std::to_string(mesh.triangles.rows()) + " triangles");
  }
}

void check_start(const ReshapeResult& start, const ReshapeOptions& options, const Mesh& mesh) {
  if (options.solver == ReshapeSolver::published) {
    throw InvalidInput(
        "Reshape::solve: the published solver's answer depends on where it starts: solve without a start");
  }
  const std::string name = "Reshape::solve: start.";
  auto check_matrix = [&](const char* matrix, const auto& given, Eigen::Index rows, const char* due) {
    if (given.rows() != rows) {
      throw InvalidInput(name + matrix + ": " + std::to_string(given.rows()) + " rows, but the mesh has " +
                         std::to_string(rows) + due);
    }
    if (!given.allFinite()) throw InvalidInput(name + matrix + ": not finite");
  };
  check_matrix("unfinished", start.unfinished, mesh.positions.rows(), " vertices");
  check_matrix("transforms", start.transforms, mesh.triangles.rows(), " triangles");
}

void check_chains(const std::vector<std::vector<int>>& chains, const Mesh& mesh) {
  if (chains.empty()) return;
  const Edges edges = edges_of(mesh.triangles);
  for (size_t c = 0; c < chains.size(); ++c) {
    for (size_t i = 0; i + 1 < chains[c].size(); ++i) {
      const int a = chains[c][i], b = chains[c][i + 1];
      if (edge_between(edges, a, b) >= 0) continue;
      throw InvalidInput("Reshape: options.straight_chains: chain " + std::to_string(c) + ": vertices " +
                         std::to_string(a) + " and " + std::to_string(b) + " are not joined by an edge");
    }
  }
}

}  // namespace swage
