// Weights as the steps take them.
#include <algorithm>
#include <cmath>

#include "plan.h"

namespace swage {
namespace {

constexpr double kTriangles = 10000;  // Of the mesh for which the steady solver's weights are given.

StepWeights as_given(const ReshapeWeights& w) {
  return {w.normal,     w.sphericity, w.scale,      w.handle,      w.straightness,      w.connect,
          w.similarity, w.normal,     w.sphericity, w.regularizer, w.normal_regularizer};
}

/// Sums over a mesh grow as it is refined, each term's with its own power of the edge length L: so their proportions,
/// and with them the answer, change. These factors hold them at what they are where L is L0.
StepWeights at_resolution(const ReshapeWeights& w, double L, double L0) {
  StepWeights weights = as_given(w);
  // The vertex step's transform, normal and sphericity terms are numbers without a unit: as many as there are
  // triangles, 1 / L².
  // Handles are as many whatever L, and chains as stiff as handles. On fewer than 1,000 triangles they would be soft.
  const double hold = std::max(0.1, std::pow(L0 / L, 2));
  weights.handle *= hold;
  weights.straightness *= hold;
  weights.scale *= L0 / L;  // 1 / L² edges, L² / L each.
  // The transform step's transform term: 1 / L² edges, L² / L each.
  weights.connect *= L0 / L;               // 1 / L² differences between neighbours, each squared L².
  weights.similarity *= L0 / L;            // The same.
  weights.transform_normal *= L / L0;      // 1 / L² numbers without a unit.
  weights.transform_sphericity *= L / L0;  // The same.
  weights.regularizer *= L / L0;           // The same.
  weights.normal_regularizer *= L / L0;    // The same.
  return weights;
}

/// Of that many equilateral triangles on as much surface.
double edge_length(double area) { return std::sqrt(4 / std::sqrt(3.0) * area / kTriangles); }

}  // namespace

ReshapeWeights ReshapeWeights::published() {
  ReshapeWeights weights;
  weights.normal = 10;
  weights.regularizer = 1e-4;
  weights.normal_regularizer = 0;
  weights.handle = weights.straightness = 1e5;
  return weights;
}

ReshapeWeights ReshapeWeights::of(ReshapeMethod method, ReshapeSolver solver) {
  ReshapeWeights weights = solver == ReshapeSolver::published ? published() : ReshapeWeights();
  if (method == ReshapeMethod::slippage) return weights;
  weights.normal /= 10;
  weights.similarity = weights.scale = 0;
  return weights;
}

const char* to_string(ReshapeMethod method) { return method == ReshapeMethod::slippage ? "slippage" : "alup"; }

const char* to_string(ReshapeSolver solver) { return solver == ReshapeSolver::steady ? "steady" : "published"; }

StepWeights step_weights(const ReshapeOptions& options, const Mesh& unit_mesh) {
  const ReshapeWeights weights = options.weights.value_or(ReshapeWeights::of(options.method, options.solver));
  if (options.solver == ReshapeSolver::published) return as_given(weights);
  const double area = area_vectors(unit_mesh.positions, unit_mesh.triangles).rowwise().norm().sum() / 2;
  return at_resolution(weights, mean_edge_length(unit_mesh.positions, unit_mesh.triangles), edge_length(area));
}

}  // namespace swage
