// The deformations that reshaping is compared with: handles move, and the rest keeps its edges, stiff or scaled.
//
// Poisson: Yu et al.: Mesh Editing with Poisson-Based Gradient Field Manipulation. SIGGRAPH 2004; as in appendix B of
//   Araújo et al.: Slippage-Preserving Reshaping of Human-Made 3D Content. ACM Transactions on Graphics 42(6), 2023.
// As rigid as possible: Sorkine, Alexa: As-Rigid-As-Possible Surface Modeling. SGP 2007; spokes and rims, and of
//   tetrahedra: Chao, Pinkall, Sanan, Schröder: A Simple Geometric Model for Elastic Deformations. SIGGRAPH 2010.
// As conformal as possible: Yoshiyasu, Ma, Yoshida, Kanehiro: As-Conformal-As-Possible Surface Registration. SGP 2014.
#pragma once

#include <memory>
#include <optional>

#include "swage/backend.h"
#include "swage/handles.h"
#include "swage/mesh.h"
#include "swage/report.h"
#include "swage/when.h"

#pragma GCC visibility push(default)
namespace swage {

enum class DeformMethod {
  poisson,      ///< Sides of triangles stay as they are, turned no more than stretched: one linear solve.
  arap,         ///< Each vertex's triangles keep their shape up to a rotation (spokes and rims, cotangent weights).
  arap_volume,  ///< So does each tetrahedron of a filling by TetGen, and the triangles of what has no inside. Where the
                ///< triangles cannot be faces of it, it joins their vertices alone; the report's paths tell.
  conformal,    ///< As arap, up to a rotation and a scale.
};

/// "poisson", "arap", "arap-volume", "conformal".
const char* to_string(DeformMethod method);

struct DeformOptions {
  DeformMethod method = DeformMethod::arap;
  std::optional<double> handle_weight;  ///< Of |vertex - target|² in the unit box, above 0; handles are met exactly
                                        ///< where none is given. The paper's, of Poisson: 1e5.
  int pass_limit = 1000;                ///< At least 1. Poisson takes one.
  double movement = 1e-3;               ///< In mean edge lengths, above 0: passes end that move no vertex farther.
  int acceleration_window = 5;          ///< Passes that the next start is made of, [0, 50]; 0 for plain ones.
  When scaffold = When::automatic;      ///< What joins components, as ReshapeOptions::scaffold.
  double filling_time_limit = 60;       ///< Seconds, above 0, for each of TetGen's runs of arap_volume.
  std::shared_ptr<Backend> backend;     ///< Does the local steps; cpu_backend() where none is given.
};

struct DeformResult {
  Positions positions;  ///< #V × 3, mesh units, the input's order.
  Report report;
};

struct DeformPlan;  ///< What is kept of a mesh between solves.

/// Deforms one mesh, any number of times. prepare() and solve() may be called from several threads at once. Solves for
/// the same handles, wherever they go, share one factorisation.
class Deform {
 public:
  /// Takes any list of triangles, as Reshape does. Components that no triangle joins are held together where they touch
  /// or cross, else joined by edges of a scaffold or to nearest points, all of which turn and scale with their ends.
  /// Throws InvalidInput where check(positions, triangles) does, no triangle has an area, or an option is out of its
  /// range.
  Deform(const PositionsRef& positions, const TrianglesRef& triangles, const DeformOptions& options = {});
  ~Deform();
  Deform(Deform&&) noexcept;
  Deform& operator=(Deform&&) noexcept;

  /// Prepares all that depends on the rest shape alone; the first solve does so where it was not done before. Returns
  /// false where `progress` cancelled. Throws Unavailable and Unsolvable where a scaffold is to be had always, or the
  /// filling of arap_volume, and cannot.
  bool prepare(const ProgressFn& progress = {});

  /// Moves the handles to their targets, from the rest shape.
  /// Throws InvalidInput as check(gesture, positions, triangles) does, and Unsolvable where the system is singular.
  DeformResult solve(const Gesture& gesture, const ProgressFn& progress = {});

  /// The same from the result of another gesture on this mesh, as while dragging. Throws InvalidInput also where it
  /// does not fit the mesh or is not finite.
  DeformResult solve(const Gesture& gesture, const DeformResult& start, const ProgressFn& progress = {});

 private:
  std::unique_ptr<DeformPlan> plan_;
};

/// One gesture on one mesh.
DeformResult deform(const PositionsRef& positions, const TrianglesRef& triangles, const Gesture& gesture,
                    const DeformOptions& options = {}, const ProgressFn& progress = {});

}  // namespace swage
#pragma GCC visibility pop
