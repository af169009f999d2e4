// What cannot be reshaped is refused, in words.
#include <cmath>
#include <initializer_list>
#include <string>
#include <utility>

#include "messages.h"
#include "plan.h"
#include "swage/error.h"

namespace swage {
namespace {

template <typename Matrix>
void check_matrix(const char* name, const Matrix& given, Eigen::Index rows, const char* due) {
  if (given.rows() != rows) {
    throw InvalidInput(std::string(name) + ": " + std::to_string(given.rows()) + " rows, but the mesh has " +
                       std::to_string(rows) + due + "; give one for each");
  }
  if (const Eigen::Index row = first_not_finite(given); row >= 0) {
    throw InvalidInput(std::string(name) + ": row " + std::to_string(row) + " is not finite; mend it");
  }
}

}  // namespace

void check_options(const ReshapeOptions& options, const Mesh& mesh) {
  const ReshapeWeights w = options.weights.value_or(ReshapeWeights());
  const auto refuse_unless = [](bool fits, const std::string& option, double value, const char* range) {
    if (!fits) throw InvalidInput("Reshape: options." + option + ": " + digits(value) + " is not " + range);
  };
  const std::initializer_list<std::pair<const char*, double>> at_least_0 = {
      {"normal", w.normal},
      {"similarity", w.similarity},
      {"connect", w.connect},
      {"sphericity", w.sphericity},
      {"scale", w.scale},
      {"normal_regularizer", w.normal_regularizer},
      {"straightness", w.straightness}};
  for (const auto& [name, weight] : at_least_0) {
    refuse_unless(weight >= 0 && std::isfinite(weight), std::string("weights.") + name, weight,
                  "finite and at least 0");
  }
  for (const auto& [name, weight] : {std::pair{"regularizer", w.regularizer}, std::pair{"handle", w.handle}}) {
    refuse_unless(weight > 0 && std::isfinite(weight), std::string("weights.") + name, weight, "finite and above 0");
  }
  refuse_unless(options.feature_angle >= 0 && options.feature_angle <= std::numbers::pi, "feature_angle",
                options.feature_angle, "in [0, pi] radians");
  refuse_unless(options.pass_limit >= 1, "pass_limit", options.pass_limit, "at least 1");
  refuse_unless(options.movement > 0 && std::isfinite(options.movement), "movement", options.movement,
                "finite and above 0");
  if (options.linear_solver == LinearSolver::multigrid &&
      (options.solver == ReshapeSolver::published || options.refactor_every_pass)) {
    throw InvalidInput(
        "Reshape: options.linear_solver: the published solver and refactor_every_pass need a factor; take the steady "
        "solver for multigrid");
  }
  refuse_unless(options.stand_in_triangles >= 100 && options.stand_in_triangles <= 1'000'000, "stand_in_triangles",
                options.stand_in_triangles, "in [100, 1000000]");
  if (options.solver == ReshapeSolver::published && options.remesh == When::always) {
    throw InvalidInput("Reshape: options.remesh: the published solver takes the mesh as it is; take the steady solver");
  }
  refuse_unless(options.acceleration_window >= 0 && options.acceleration_window <= 50, "acceleration_window",
                options.acceleration_window, "in [0, 50]");
  if (!options.unit_box_curvatures) return;
  check_matrix("Reshape: options.unit_box_curvatures", *options.unit_box_curvatures, mesh.triangles.rows(),
               " triangles");
}

void check_start(const ReshapeResult& start, const ReshapeOptions& options, const Mesh& mesh) {
  if (options.solver == ReshapeSolver::published) {
    throw InvalidInput(
        "Reshape::solve: the published solver's answer depends on where it starts: solve without a start");
  }
  check_matrix("Reshape::solve: start.unfinished", start.unfinished, mesh.positions.rows(), " vertices");
  check_matrix("Reshape::solve: start.transforms", start.transforms, mesh.triangles.rows(), " triangles");
}

void check_chains(const std::vector<std::vector<int>>& chains, const Mesh& mesh) {
  if (chains.empty()) return;
  const Edges edges = edges_of(mesh.triangles);
  for (size_t c = 0; c < chains.size(); ++c) {
    for (size_t i = 0; i + 1 < chains[c].size(); ++i) {
      const int a = chains[c][i], b = chains[c][i + 1];
      if (edge_between(edges, a, b) >= 0) continue;
      throw InvalidInput("Reshape: options.straight_chains: chain " + std::to_string(c) + ": vertices " +
                         std::to_string(a) + " and " + std::to_string(b) +
                         " are not joined by an edge; name vertices along edges");
    }
  }
}

}  // namespace swage
