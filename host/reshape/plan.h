// What a prepared reshaping keeps, and the verbs that solve() is told in.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "anderson.h"
#include "block_system.h"
#include "given.h"
#include "holds.h"
#include "matrices.h"
#include "measures.h"
#include "multilevel.h"
#include "pool.h"
#include "preparation.h"
#include "shape_quality.h"
#include "stopwatch.h"
#include "surface.h"
#include "swage/reshape.h"
#include "swage/scaffold.h"
#include "tie.h"

namespace swage {

/// Three consecutive vertices of a straight chain with the edges between them.
struct StraightTriple {
  int before, middle, after;
  int edge_before, edge_after;
};

/// What vertices are to each other besides edges of triangles. In the unit box.
struct Bonds {
  std::vector<StraightTriple> straight = {};
  double straightness_weight = 0;
  double firm_length = 0;  ///< Chains are no firmer where their edges are shorter.
  std::vector<Tie> ties = {};
};

/// Points held softly. In the unit box.
struct Holds {
  std::vector<Hold> points;
  double weight = 0;
};

/// The vertex step's system and what goes into it.
struct VertexSystem {
  BlockSystem system;
  std::shared_ptr<const BlockSystem::Stars> edges;
  std::shared_ptr<const Eigen::VectorXd> constant;  ///< The matrix's values of sphericity and ties, which never change.
  std::optional<Multilevel> multilevel = {};        ///< Of a pass before, where the system is not factored.
  int solves = 0;                                   ///< By it.

  /// The same, as new.
  VertexSystem unsolved() const { return {system.unfactored(), edges, constant}; }
  std::size_t bytes() const {
    return system.bytes() + edges->rays.size() * sizeof(BlockSystem::Stars::Ray) +
           (multilevel ? multilevel->bytes() : 0);
  }
  /// As if nothing had been solved.
  void forget() {
    system.forget_factor();
    multilevel.reset();
    solves = 0;
  }
};

/// Weights of the terms in each step.
struct StepWeights {
  double normal, sphericity, scale, handle, straightness;  // Vertex step.
  double connect, similarity, transform_normal, transform_sphericity, regularizer,
      normal_regularizer;  // Transform step.
};

/// What a solve changes and a later one goes on with: memory and symbolic analyses, never values.
struct Workspace {
  std::unique_ptr<TransformStep> step;
  VertexSystem vertices;
  std::optional<BlockSystem> transforms;   ///< Where every pass is to factor it.
  std::unique_ptr<CouplingStep> coupling;  ///< Where none is.
};

/// How the global systems are solved.
struct Paths {
  LinearSolver vertices = LinearSolver::factor, transforms = LinearSolver::factor;  ///< Never automatic.
  std::string why_vertices, why_transforms, why_no_coarse_start;
  std::string components = "one", mesh = "as given";
};

struct CoarsePlan;
struct StandIn;

/// Solves read it, several at once, but for the pool.
struct ReshapePlan {
  ReshapeOptions options;
  std::optional<Given> given;  ///< Where what follows is not as given.
  Mesh mesh;                   ///< Mesh units.
  SurfaceCounts counts;
  UnitBox box;
  Edges edges;
  Bonds bonds;

  // Filled by prepare().
  StepWeights weights = {};
  std::shared_ptr<const TransformStep::Rest> rest = {};
  std::optional<VertexSystem> vertices = {};  ///< Never factored: workspaces have copies.
  Paths paths = {};
  int components = 1, flat_triangles = 0;
  ShapeQuality quality = {};
  std::optional<BlockSystem> transforms = {};  ///< Factored, where it is to be.
  std::optional<Multilevel> multilevel = {};   ///< Where not.
  std::shared_ptr<const CoarsePlan> coarse = {};
  Tetrahedra scaffold = {};                ///< Of rest's vertices, where there is one.
  std::shared_ptr<StandIn> stand_in = {};  ///< Solved in place of all this, of which then nothing is prepared.
  double prepare_seconds = 0;
  bool prepared = false;

  std::mutex preparing = {};
  mutable Pool<Workspace> workspaces = {};
};

/// One solve's state.
struct Iterate {
  Workspace& work;
  Anderson acceleration{0};
  Holds handles = {};
  Transforms transforms = {};
  Positions before = {};             ///< As the last pass found them.
  Transforms right_hand_sides = {};  ///< Of the transform step, for the positions last placed.
  TransformStep::EdgeQuadratics quadratics = {};
  std::vector<std::map<std::string, double>> energy_by_term = {};  ///< Of each pass.
  int singular = 0;  ///< Most triangles in a pass whose transform had to be damped.
  std::map<std::string, double> seconds = {};
};

// plan_of.cpp
std::unique_ptr<ReshapePlan> plan_of(Mesh mesh, const ReshapeOptions& options);

// solve.cpp
/// Of points of the mesh as given. Fills `result.report`.
ReshapeResult solve_holds(ReshapePlan& plan, const std::vector<Hold>& holds, const ReshapeResult* start,
                          const ProgressFn& progress);

// plan.cpp
/// Once. False where `progress` cancelled: another call begins anew.
bool prepare(ReshapePlan& plan, const ProgressFn& progress);
/// For a solve of a prepared plan.
std::unique_ptr<Workspace> workspace(const ReshapePlan& plan, const Poll& poll = {});

// tell.cpp
/// What was done.
void tell(const ReshapePlan& plan, const Iterate& iterate, bool warm, Report& report);
/// What of the mesh is not as of one well-made surface, and handles that are not where they were asked to.
void warn(const ReshapePlan& plan, const Gesture& gesture, ReshapeResult& result);

// check.cpp
void check_options(const ReshapeOptions& options, const Mesh& mesh);
void check_chains(const std::vector<std::vector<int>>& chains, const Mesh& mesh);
void check_start(const ReshapeResult& start, const ReshapeOptions& options, const Mesh& mesh);

// paths.cpp
/// What the transform step's factor is expected to take while it is made, bytes.
double factor_bytes(Eigen::Index triangle_count);
Paths choose_paths(const ReshapeOptions& options, Eigen::Index vertex_count, Eigen::Index triangle_count,
                   bool has_straight_chains);

// weights.cpp
/// As the options' solver takes them on a mesh in the unit box.
StepWeights step_weights(const ReshapeOptions& options, const Mesh& unit_mesh);

// prepare.cpp
std::vector<StraightTriple> straight_triples(const std::vector<std::vector<int>>& chains, const Edges& edges);
TransformStep::Rest rest_shape(const ReshapeOptions& options, const Mesh& unit_mesh, const Edges& edges,
                               const Curvatures& unit_box_curvatures);
/// The terms of eq. 35 within triangle t: transform, normal, sphericity, regularizer.
Eigen::Matrix<double, 9, 9> triangle_block(const TransformStep::Rest& rest, Eigen::Index t);
/// Those across pair p, connect and similarity, for each row of the difference of the pair's transforms.
Eigen::Matrix3d pair_block(const TransformStep::Rest& rest, Eigen::Index p);
/// To be factored by `kind`, or by whatever is faster.
VertexSystem vertex_system(const TransformStep::Rest& rest, const Bonds& bonds, std::optional<FactorKind> kind = {},
                           const Poll& poll = {});
BlockSystem transform_system(const TransformStep::Rest& rest, std::optional<FactorKind> kind = {},
                             const Poll& poll = {});

// global.cpp
/// The sphericity term and ties as values of the vertex step's matrix.
Eigen::VectorXd constant_values(BlockSystem& system, const TransformStep::Rest& rest, const std::vector<Tie>& ties,
                                const Poll& poll = {});
/// The vertex step's quadratic x' A x - 2 b' x (eq. 23 with section 4's terms): A into the system; returns b.
Eigen::VectorXd assemble(VertexSystem& vertices, const TransformStep::Rest& rest,
                         const TransformStep::EdgeQuadratics& quadratics, const Bonds& bonds,
                         const std::vector<Holds>& holds);
/// Minimises it.
Positions place_vertices(VertexSystem& vertices, const TransformStep::Rest& rest,
                         const TransformStep::EdgeQuadratics& quadratics, const Bonds& bonds,
                         const std::vector<Holds>& holds, const Positions& start, const Poll& poll = {});
/// The same of a system without a factor; none where that would take longer than to make one: on needles, which vary
/// too much, and on straight chains, of which multigrid does not know.
std::optional<Positions> place_by_multigrid(VertexSystem& vertices, const TransformStep::Rest& rest,
                                            const TransformStep::EdgeQuadratics& quadratics, const Bonds& bonds,
                                            const std::vector<Holds>& holds, const Positions& start, const Poll& poll);
/// Minimises the transform step's quadratic (eq. 35).
Transforms solve_transforms(const BlockSystem& system, const Transforms& right_hand_sides);

/// Brings transforms near its minimum still nearer.
Transforms improved_transforms(const BlockSystem& system, const Transforms& right_hand_sides,
                               const Transforms& transforms);

/// The same without a factor.
Transforms improved_transforms(const Multilevel& multilevel, CouplingStep& matrix, const Transforms& right_hand_sides,
                               const Transforms& transforms, const Poll& poll);

// energy.cpp
/// The terms by name, weighted; their sum decides when to stop.
std::map<std::string, double> energy_terms(const TransformStep::Energy& local, const Positions& positions,
                                           const Bonds& bonds, const StepWeights& weights, const Holds& handles);
double sum(const std::map<std::string, double>& terms);

/// Largest distance of a handle from its target.
double largest_miss(const Holds& handles, const Positions& positions);

// dimples.cpp
/// Handles beside which the surface turns far more than a way off: in a dimple (appendix A).
std::vector<Hold> dimples(const Holds& handles, const TransformStep::Rest& rest, const Positions& positions);
/// The published finalising: one vertex step, in which the rings around dimples let go of their handles. None where
/// there are no dimples.
std::optional<Positions> let_go(const ReshapePlan& plan, Iterate& iterate, const Positions& positions,
                                const Poll& poll);

// finish.cpp
/// Goes on from positions, with the iterate's transforms and handles, to where passes end. False where cancelled.
using GoOn = std::function<bool(Positions&)>;
/// Improves what the passes left, where handles miss or sit in dimples, and tells what was done. None where there was
/// nothing to do, or it made nothing better. `iterate` is of no use afterwards.
std::optional<Positions> finished(const ReshapePlan& plan, Iterate& iterate, const Positions& positions,
                                  const GoOn& go_on, const Poll& poll, std::string& told);

}  // namespace swage
