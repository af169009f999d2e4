// Slippage-preserving reshaping: handles move, proportions change, orientation and surface structure stay.
//
// Araújo, Vining, Burla, Ruivo de Oliveira, Rosales, Sheffer: Slippage-Preserving Reshaping of Human-Made 3D Content.
// ACM Transactions on Graphics 42(6), 2023. https://doi.org/10.1145/3618391
#pragma once

#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include "swage/backend.h"
#include "swage/curvature.h"
#include "swage/handles.h"
#include "swage/mesh.h"
#include "swage/report.h"

namespace swage {

/// Weights of the energy's terms (paper section 4), for a mesh scaled into the unit box. Finite, none negative;
/// handle and regularizer above 0.
struct ReshapeWeights {
  double normal = 10;         ///< w_normal
  double similarity = 1;      ///< of E_similarity
  double connect = 1;         ///< of E_connect
  double sphericity = 1;      ///< of E_sphericity
  double scale = 1e-4;        ///< w_scale
  double regularizer = 1e-4;  ///< w_reg
  double handle = 1e5;        ///< w_constr of E_pos
  double straightness = 1e5;  ///< w_constr of E_straight
};

struct ReshapeOptions {
  ReshapeWeights weights;
  double feature_angle = std::numbers::pi * 105 / 180;  ///< Interior dihedral angle in radians, [0, pi]: surfaces
                                                        ///< beside a sharper edge stretch independently.
  std::optional<Curvatures> unit_box_curvatures;  ///< #T × 2, of the mesh scaled into the unit box; else computed.
  std::vector<std::vector<int>> straight_chains;  ///< Chains of vertices, joined by edges, that stay straight.
  int pass_limit = 100;                           ///< At least 1.
  bool finalise = true;                           ///< Spread dimples at handles (appendix A).
  bool refactor_every_pass = false;               ///< As published: the same result, slower. For comparison.
  std::shared_ptr<Backend> backend;               ///< Does the local steps; cpu_backend() where none is given.
};

struct ReshapeResult {
  Positions positions;     ///< #V × 3, mesh units, the input's order.
  Positions unfinished;    ///< The same before finalising.
  bool finalised = false;  ///< Whether a dimple was found and spread.
  Report report;
};

struct ReshapePlan;  ///< What is kept of a mesh between solves.

/// Reshapes one mesh, any number of times.
class Reshape {
 public:
  /// Throws InvalidInput where check(positions, triangles) does, an edge has not two triangles of one orientation, a
  /// triangle is degenerate, or an option is out of its range.
  Reshape(const PositionsRef& positions, const TrianglesRef& triangles, const ReshapeOptions& options = {});
  ~Reshape();
  Reshape(Reshape&&) noexcept;
  Reshape& operator=(Reshape&&) noexcept;

  /// Prepares all that depends on the rest shape alone, among it the one factorisation of the transform step's
  /// matrix. The first solve does so where it was not done before. Returns false where `progress` cancelled.
  bool prepare(const ProgressFn& progress = {});

  /// Moves the handles to their targets by the published alternation. Does not depend on earlier solves.
  /// Throws InvalidInput as check(gesture, positions, triangles) does, and Unsolvable where a system is singular.
  ReshapeResult solve(const Gesture& gesture, const ProgressFn& progress = {});

 private:
  std::unique_ptr<ReshapePlan> plan_;
};

/// One gesture on one mesh.
ReshapeResult reshape(const PositionsRef& positions, const TrianglesRef& triangles, const Gesture& gesture,
                      const ReshapeOptions& options = {}, const ProgressFn& progress = {});

}  // namespace swage
