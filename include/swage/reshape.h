// Slippage-preserving reshaping: handles move, proportions change, orientation and surface structure stay.
//
// Araújo, Vining, Burla, Ruivo de Oliveira, Rosales, Sheffer: Slippage-Preserving Reshaping of Human-Made 3D Content.
// ACM Transactions on Graphics 42(6), 2023. https://doi.org/10.1145/3618391
#pragma once

#include <cstddef>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include "swage/backend.h"
#include "swage/curvature.h"
#include "swage/features.h"
#include "swage/handles.h"
#include "swage/mesh.h"
#include "swage/report.h"
#include "swage/scaffold.h"
#include "swage/steps.h"
#include "swage/when.h"

#pragma GCC visibility push(default)
namespace swage {

enum class ReshapeMethod {
  slippage,  ///< Surfaces stretch as they may while they go on sliding along themselves (section 4).
  alup,      ///< Its forerunner: surfaces scale as locally uniformly as possible (section 3), so conformality counts on
             ///< every triangle, and neither similarity across edges nor scale does.
};

/// "slippage", "alup".
const char* to_string(ReshapeMethod method);

enum class ReshapeSolver {
  steady,     ///< To the fixed point of a problem whose answer depends neither on the mesh's resolution nor on when
              ///< passes stop: the paper's terms with other weights (host/reshape/steady.md).
  published,  ///< The published alternation with its stop tests, which end it on the way to a fixed point.
};

/// "steady", "published".
const char* to_string(ReshapeSolver solver);

/// What the two global systems of a pass are solved by: three unknowns a vertex, nine a triangle.
enum class LinearSolver {
  automatic,  ///< Vertices by multigrid from 1,500 on where no chains are straight and a trial takes few iterations,
              ///< else by a factor; transforms by a factor where it fits into ReshapeOptions::factor_memory, else by
              ///< multigrid.
  factor,     ///< Sparse Cholesky. The transforms' takes 2.5 GB at 84,000 triangles, and grows faster than the mesh.
  multigrid,  ///< Conjugate gradients preconditioned by aggregation multigrid, far enough for the passes to reach the
              ///< same fixed point within their stop's tolerance. Straight chains still have their vertices factored.
              ///< Steady solver only.
};

/// "auto", "factor", "multigrid".
const char* to_string(LinearSolver solver);

/// Weights of the energy's terms (paper section 4), for a mesh scaled into the unit box. Finite, none negative;
/// handle and regularizer above 0. The defaults are the steady solver's, which takes them as of a mesh of 10,000 equal
/// triangles and scales them to the one given.
struct ReshapeWeights {
  double normal = 12;                ///< w_normal
  double similarity = 1;             ///< of E_similarity
  double connect = 1;                ///< of E_connect
  double sphericity = 1;             ///< of E_sphericity; in ALUP of E_conformal
  double scale = 1e-4;               ///< w_scale
  double regularizer = 1e-3;         ///< w_reg
  double normal_regularizer = 6e-3;  ///< Of |T n - n|², which the paper has not (host/reshape/steady.md).
  double handle = 4e5;               ///< w_constr of E_pos
  double straightness = 4e5;         ///< w_constr of E_straight

  /// The paper's: normal 10, regularizer 1e-4, none of the normal's, handle and straightness 1e5.
  static ReshapeWeights published();
  /// A method's, as a solver takes them. Of ALUP: normal a tenth, none of similarity and scale.
  static ReshapeWeights of(ReshapeMethod method, ReshapeSolver solver);
};

struct ReshapeOptions {
  ReshapeMethod method = ReshapeMethod::slippage;
  ReshapeSolver solver = ReshapeSolver::steady;
  std::optional<ReshapeWeights> weights;                ///< The method's own where none are given.
  double feature_angle = std::numbers::pi * 105 / 180;  ///< Interior dihedral angle in radians, [0, pi]: surfaces
                                                        ///< beside a sharper edge stretch independently.
  std::optional<Curvatures> unit_box_curvatures;  ///< #T × 2, of the mesh scaled into the unit box; else computed.
  std::vector<std::vector<int>> straight_chains;  ///< Chains of vertices, joined by edges, that stay straight.
  std::optional<StraightOptions> find_chains;     ///< Where none are given: those found on what is solved.
  int pass_limit = 100;                           ///< At least 1.
  double movement = 1e-3;                         ///< Steady: in mean edge lengths, above 0. The farthest that one more
                                                  ///< pass would move a vertex.
  int acceleration_window = 5;                    ///< Steady: passes that the next start is made of; 0 for plain ones.
  LinearSolver linear_solver = LinearSolver::automatic;
  std::size_t factor_memory = 0;     ///< Bytes that automatic lets the transforms' factor take; 0 for a quarter of the
                                     ///< machine's memory, whoever else uses it, at most 4 GiB.
  bool coarse_start = false;         ///< Steady, from 40,000 triangles on: first solve a coarse stand-in.
                                     ///< Fewer passes on models of many parts, more on smooth ones.
  bool finalise = true;              ///< Hold handles harder that miss by 0.5 % of the diagonal, and spread dimples
                                     ///< (appendix A), where that is better. Published: as published.
  When scaffold = When::automatic;   ///< Components that no triangle joins: by tetrahedra between them (section 5.1),
                                     ///< automatically where they neither touch nor cross, else by links between
                                     ///< nearest points. Where they touch or cross they are held together there.
  When remesh = When::never;         ///< Solve a remeshed stand-in and carry the edit back to the mesh (section 5.1),
                                     ///< automatically where triangles are needles, uneven or too coarse. Curvatures
                                     ///< and chains given are of the mesh: automatically no stand-in then, else unused.
  int stand_in_triangles = 10'000;   ///< About as many has the stand-in; in [100, 1,000,000].
  bool refactor_every_pass = false;  ///< As published: the same result, slower. For comparison.
  std::shared_ptr<Backend> backend;  ///< Does the local steps; cpu_backend() where none is given.
};

/// The tetrahedra that join components, reshaped with them.
struct ReshapedScaffold {
  Positions positions;  ///< The mesh's #V, then the scaffold's own; mesh units.
  Tetrahedra tetrahedra;
};

struct ReshapeResult {
  Positions positions;      ///< #V × 3, mesh units, the input's order.
  Positions unfinished;     ///< The same before finalising.
  Transforms transforms;    ///< #T × 9: rest edge → edited edge, of `unfinished` to the stop's tolerance.
  int straight_chains = 0;  ///< That were kept straight, on the stand-in where one was solved.
  bool finalised = false;   ///< Whether finalising changed anything.
  std::optional<ReshapedScaffold> scaffold;       ///< Where there is one.
  std::shared_ptr<const ReshapeResult> stand_in;  ///< Of the remeshed stand-in, where one was solved.
  Report report;
};

struct ReshapePlan;  ///< What is kept of a mesh between solves.

/// Reshapes one mesh, any number of times. prepare() and solve() may be called from several threads at once: the first
/// prepares, the others wait, then each solves by itself, and results are the same bytes whatever else runs. Memory for
/// as many solves as ever ran at once stays until the end. Solves use several threads themselves, so callers that fill
/// the cores with solves do best to call omp_set_num_threads(1) in each of their threads.
class Reshape {
 public:
  /// Takes any list of triangles: open, of edges of three and more, wound against each other, repeated, without area,
  /// in parts. Vertices within 1e-6 of the box's extent of each other are one; those of no triangle go with the nearest
  /// surface. What of this was found is among the report's warnings.
  /// Throws InvalidInput where check(positions, triangles) does, no triangle has an area, or an option is out of its
  /// range.
  Reshape(const PositionsRef& positions, const TrianglesRef& triangles, const ReshapeOptions& options = {});
  ~Reshape();
  Reshape(Reshape&&) noexcept;
  Reshape& operator=(Reshape&&) noexcept;

  /// Prepares all that depends on the rest shape alone, among it the one factorisation of the transform step's
  /// matrix. The first solve does so where it was not done before. Returns false where `progress` cancelled; it must
  /// not use this object. Throws Unavailable and Unsolvable where a scaffold or a stand-in is to be had always, and
  /// cannot.
  bool prepare(const ProgressFn& progress = {});

  /// Moves the handles to their targets. Does not depend on earlier solves.
  /// Handles that are vertices of no triangle go where they are asked to; where all are, so does the surface nearest to
  /// them. Throws InvalidInput as check(gesture, positions, triangles) does, and Unsolvable where a system is singular.
  ReshapeResult solve(const Gesture& gesture, const ProgressFn& progress = {});

  /// The same from the result of another gesture on this mesh, as while dragging, instead of the rest shape: fewer
  /// passes to the same fixed point, within the stop's tolerance. Reads start.unfinished and start.transforms, or
  /// start.stand_in where one is solved.
  /// Throws InvalidInput also where these do not fit the mesh or are not finite, and for the published solver, whose
  /// answer depends on where it starts.
  ReshapeResult solve(const Gesture& gesture, const ReshapeResult& start, const ProgressFn& progress = {});

 private:
  std::unique_ptr<ReshapePlan> plan_;
};

/// One gesture on one mesh.
ReshapeResult reshape(const PositionsRef& positions, const TrianglesRef& triangles, const Gesture& gesture,
                      const ReshapeOptions& options = {}, const ProgressFn& progress = {});

}  // namespace swage
#pragma GCC visibility pop
