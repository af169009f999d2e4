// What a prepared deformation keeps, and the verbs that solve() is told in.
//
// All four minimise sum over elements n and their edges p of w_p |e_p - M_n e0_p|², e0 the edge at rest: each pass the
// vertices for the matrices M, then the matrices for the vertices. They differ in what is an element (a triangle, a
// vertex's triangles, a tetrahedron) and in what M may be: the identity, a rotation, a similarity.
#pragma once

#include <Eigen/SparseCholesky>
#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "elements.h"
#include "given.h"
#include "holds.h"
#include "measures.h"
#include "pool.h"
#include "stopwatch.h"
#include "swage/deform.h"

namespace swage {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// Both sides of the vertices' system: laplacian * positions = turned_edges * (all matrices M', one below the other).
struct GlobalSystem {
  SparseMatrix laplacian;                                          ///< #V × #V
  Eigen::SparseMatrix<double, Eigen::RowMajor> turned_edges = {};  ///< #V × 3 #N
};

/// The laplacian for a set of handles.
struct HeldSystem {
  std::vector<std::array<int, 3>> key;         ///< Vertices of the holds that it is for.
  std::vector<int> fixed, free;                ///< Vertices; those that are fixed have their targets.
  SparseMatrix coupling;                       ///< #free × #fixed
  Eigen::SimplicialLDLT<SparseMatrix> factor;  ///< Of the free.
};

struct DeformSteps {
  std::unique_ptr<RotationStep> rotation;
  std::unique_ptr<SimilarityStep> similarity;
};

struct DeformPlan {
  DeformOptions options;
  std::optional<Given> given;  ///< Where what follows is not as given.
  Mesh mesh;                   ///< Mesh units.
  SurfaceCounts counts;
  UnitBox box;
  Edges edges;

  // Filled by prepare().
  Elements elements = {};  ///< In the unit box.
  GlobalSystem system = {};
  double mean_edge_length = 0;
  int components = 1, flat_triangles = 0;
  std::string told_components = "one", told_filling = {};
  double prepare_seconds = 0;
  bool prepared = false;

  std::mutex preparing = {};
  std::mutex holding = {};
  std::shared_ptr<const HeldSystem> held = {};  ///< For the handles last solved for.
  Pool<DeformSteps> workspaces = {};
};

/// Of a whole call's progress, what preparation is.
constexpr double kPrepared = 0.2;

// check.cpp
void check_options(const DeformOptions& options);
void check_start(const DeformResult& start, const Mesh& mesh);

// prepare.cpp
std::unique_ptr<DeformPlan> plan_of(Mesh mesh, const DeformOptions& options);
/// Once. False where `progress` cancelled: another call begins anew.
bool prepare(DeformPlan& plan, const ProgressFn& progress);

// global.cpp
GlobalSystem global_system(const PairsRest& pairs);
/// Its factor; the plan's where that is for the same handles.
std::shared_ptr<const HeldSystem> held_system(DeformPlan& plan, const std::vector<Hold>& holds);
/// The vertices that minimise the energy for the matrices. Targets in the unit box.
Positions place_vertices(const DeformPlan& plan, const HeldSystem& held, const std::vector<Hold>& holds,
                         const Transforms& matrices);

// energy.cpp
/// Of the elements' edges.
double edge_energy(const PairsRest& pairs, const Positions& positions, const Transforms& matrices);
/// Of holds that are not met exactly.
double hold_energy(const DeformOptions& options, const std::vector<Hold>& holds, const Positions& positions);

}  // namespace swage
