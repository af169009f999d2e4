// Slippage-preserving reshaping: handles move, proportions change, orientation and surface structure stay.
//
// Araújo, Vining, Burla, Ruivo de Oliveira, Rosales, Sheffer: Slippage-Preserving Reshaping of Human-Made 3D Content.
// ACM Transactions on Graphics 42(6), 2023. https://doi.org/10.1145/3618391
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "swage/backend.h"
#include "swage/curvature.h"
#include "swage/handles.h"
#include "swage/mesh.h"
#include "swage/report.h"

namespace swage {

/// Weights of the energy's terms (paper section 4), for a mesh scaled into the unit box.
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
  double feature_angle = 1.8325957145940461;      ///< Interior dihedral angle, radians (105°): the surfaces on both
                                                  ///< sides of a sharper edge stretch independently.
  std::optional<Curvatures> unit_box_curvatures;  ///< #T × 2, for the mesh scaled into the unit box; else computed.
  std::vector<std::vector<int>> straight_chains;  ///< Vertex chains that stay straight.
  int pass_limit = 100;                           ///< At least 1.
  bool finalise = true;                           ///< Spread dimples at handles (appendix A, Finalizing Outputs).
  bool refactor_every_pass = false;               ///< As the paper solves it, for comparison: same result, slower.
  std::shared_ptr<Backend> backend;               ///< Who does the local steps; cpu_backend() where none is given.
};

struct ReshapeResult {
  Positions positions;     ///< #V × 3, mesh units, the input's order.
  Positions unfinished;    ///< The same before finalising.
  bool finalised = false;  ///< Whether a dimple was found and spread.
  Report report;
};

/// Reshapes one mesh, any number of times.
class Reshape {
 public:
  /// Prepares all that depends on the rest shape alone: one factorisation of the transform step's matrix among it.
  /// `progress` may cancel: then solve() throws Unsolvable.
  /// Throws InvalidInput where check(positions, triangles) does, an edge has one triangle or more than two, a
  /// triangle is degenerate, or an option is out of its range.
  Reshape(const PositionsRef& positions, const TrianglesRef& triangles, const ReshapeOptions& options = {},
          const ProgressFn& progress = {});
  ~Reshape();
  Reshape(Reshape&&) noexcept;
  Reshape& operator=(Reshape&&) noexcept;

  /// Positions in which the handles are at their targets and the energy is as the published alternation leaves it.
  /// A solve does not depend on those before it.
  /// Throws InvalidInput as check(gesture, positions, triangles) does.
  ReshapeResult solve(const Gesture& gesture, const ProgressFn& progress = {});

 private:
  struct Plan;
  std::unique_ptr<Plan> plan_;
};

/// One gesture on one mesh.
ReshapeResult reshape(const PositionsRef& positions, const TrianglesRef& triangles, const Gesture& gesture,
                      const ReshapeOptions& options = {}, const ProgressFn& progress = {});

}  // namespace swage
