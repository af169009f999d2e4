// What a prepared reshaping keeps, and the verbs that solve() is told in.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "anderson.h"
#include "block_system.h"
#include "measures.h"
#include "pool.h"
#include "stopwatch.h"
#include "swage/reshape.h"

namespace swage {

/// Three consecutive vertices of a straight chain with the edges between them.
struct StraightTriple {
  int before, middle, after;
  int edge_before, edge_after;
};

/// Vertices held at targets, softly. In the unit box.
struct Holds {
  std::vector<int> vertices;
  Positions targets;  ///< A row a vertex.
  double weight = 0;
};

/// The vertex step's system and what goes into it besides the edges.
struct VertexSystem {
  BlockSystem system;
  std::shared_ptr<const Eigen::VectorXd> sphericity;  ///< The matrix's values of the sphericity term alone.
};

/// Weights of the terms in each step.
struct StepWeights {
  double normal, sphericity, scale, handle, straightness;                           // Vertex step.
  double connect, similarity, transform_normal, transform_sphericity, regularizer;  // Transform step.
};

/// What a solve changes and a later one goes on with: memory and symbolic analyses, never values.
struct Workspace {
  std::unique_ptr<TransformStep> step;
  VertexSystem vertices;
  std::optional<BlockSystem> transforms;  ///< Where every pass is to factor it.
};

/// Solves read it, several at once, but for the pool.
struct ReshapePlan {
  ReshapeOptions options;
  Mesh mesh;  ///< As given, mesh units.
  UnitBox box;
  Edges edges;
  std::vector<StraightTriple> straight;

  // Filled by prepare().
  StepWeights weights = {};
  TransformStep::Rest rest = {};
  std::optional<VertexSystem> vertices = {};  ///< Never factored: workspaces have copies.
  std::optional<BlockSystem> transforms = {};
  double prepare_seconds = 0;

  std::mutex preparing = {};
  mutable Pool<Workspace> workspaces = {};

  bool prepared() const { return transforms.has_value(); }
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

// check.cpp
void check_options(const ReshapeOptions& options, const Mesh& mesh);
void check_surface(const Mesh& mesh, const Edges& edges);
void check_start(const ReshapeResult& start, const ReshapeOptions& options, const Mesh& mesh);

// weights.cpp
/// As the options' solver takes them on a mesh in the unit box.
StepWeights step_weights(const ReshapeOptions& options, const Mesh& unit_mesh);

// prepare.cpp
std::vector<StraightTriple> straight_triples(const std::vector<std::vector<int>>& chains, const Edges& edges,
                                             int vertex_count);
TransformStep::Rest rest_shape(const ReshapeOptions& options, const Mesh& unit_mesh, const Edges& edges,
                               const Curvatures& unit_box_curvatures);
/// Factored by `kind`, or by whatever is faster.
VertexSystem vertex_system(const TransformStep::Rest& rest, const std::vector<StraightTriple>& straight,
                           std::optional<FactorKind> kind = {});
BlockSystem transform_system(const TransformStep::Rest& rest, std::optional<FactorKind> kind = {});

// global.cpp
/// The sphericity term as values of the vertex step's matrix.
Eigen::VectorXd sphericity_values(BlockSystem& system, const TransformStep::Rest& rest);
/// The vertex step's quadratic x' A x - 2 b' x (eq. 23 with section 4's terms): A into the system; returns b.
Eigen::VectorXd assemble(VertexSystem& vertices, const TransformStep::Rest& rest,
                         const TransformStep::EdgeQuadratics& quadratics, const std::vector<StraightTriple>& straight,
                         double straightness_weight, const std::vector<Holds>& holds);
/// Minimises it.
Positions place_vertices(VertexSystem& vertices, const TransformStep::Rest& rest,
                         const TransformStep::EdgeQuadratics& quadratics, const std::vector<StraightTriple>& straight,
                         double straightness_weight, const std::vector<Holds>& holds, const Positions& start);
/// Minimises the transform step's quadratic (eq. 35).
Transforms solve_transforms(const BlockSystem& system, const Transforms& right_hand_sides);

/// Brings transforms near its minimum still nearer.
Transforms improved_transforms(const BlockSystem& system, const Transforms& right_hand_sides,
                               const Transforms& transforms);

/// #T × 9 identity matrices.
Transforms identities(Eigen::Index triangle_count);

// energy.cpp
/// The terms by name, weighted; their sum decides when to stop.
std::map<std::string, double> energy_terms(const TransformStep::Energy& local, const Positions& positions,
                                           const std::vector<StraightTriple>& straight, const StepWeights& weights,
                                           const Holds& handles);
double sum(const std::map<std::string, double>& terms);

// finish.cpp
/// Where a handle sits in a dimple, the positions with its error spread over the rings around (appendix A).
std::optional<Positions> spread_dimples(const ReshapePlan& plan, const Iterate& iterate, const Positions& positions);

}  // namespace swage
