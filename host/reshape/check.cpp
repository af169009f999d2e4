// What cannot be reshaped is refused, in words.
#include <algorithm>
#include <cmath>
#include <string>

#include "plan.h"
#include "swage/error.h"

namespace swage {
namespace {

void check_shape(const Mesh& mesh, const Positions& areas, int t) {
  double longest = 0;
  for (int k = 0; k < 3; ++k) {
    const auto a = mesh.positions.row(mesh.triangles(t, k)), b = mesh.positions.row(mesh.triangles(t, (k + 1) % 3));
    longest = std::max(longest, (a - b).squaredNorm());
  }
  // A height below 1e-10 of the longest side leaves the normal to rounding.
  if (areas.row(t).norm() > 1e-10 * longest) return;
  throw InvalidInput("Reshape: triangle " + std::to_string(t) + " is degenerate (vertices " +
                     std::to_string(mesh.triangles(t, 0)) + ", " + std::to_string(mesh.triangles(t, 1)) + ", " +
                     std::to_string(mesh.triangles(t, 2)) + "); remove or remesh it");
}

/// Whether the triangle runs along the edge from its first vertex to its second.
bool runs_along(const Triangles& triangles, int t, const Eigen::RowVector2i& edge) {
  for (int k = 0; k < 3; ++k) {
    if (triangles(t, k) == edge[0] && triangles(t, (k + 1) % 3) == edge[1]) return true;
  }
  return false;
}

void check_edge(const Triangles& triangles, const Edges& edges, int e) {
  const Lists::Range beside = edges.triangles[e];
  const Eigen::RowVector2i edge = edges.vertices.row(e);
  const std::string name = "Reshape: edge " + std::to_string(edge[0]) + "-" + std::to_string(edge[1]);
  if (beside.size() == 1) throw InvalidInput(name + " has 1 triangle: close the surface there");
  if (beside.size() > 2) {
    throw InvalidInput(name + " has " + std::to_string(beside.size()) + " triangles: make the surface manifold there");
  }
  if (runs_along(triangles, beside[0], edge) == runs_along(triangles, beside[1], edge)) {
    throw InvalidInput(name + " has triangles of opposite orientation (" + std::to_string(beside[0]) + " and " +
                       std::to_string(beside[1]) + "): orient the surface consistently");
  }
}

}  // namespace

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

void check_surface(const Mesh& mesh, const Edges& edges) {
  const Positions areas = area_vectors(mesh.positions, mesh.triangles);
  for (int t = 0; t < mesh.triangles.rows(); ++t) check_shape(mesh, areas, t);
  for (int e = 0; e < edges.triangles.size(); ++e) check_edge(mesh.triangles, edges, e);
}

}  // namespace swage
