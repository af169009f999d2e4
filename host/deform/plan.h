// What a prepared deformation keeps, and the verbs that solve() is told in.
//
// All four minimise sum over elements n and their edges p of w_p |e_p - M_n e0_p|², e0 the edge at rest: each pass the
// vertices for the matrices M, then the matrices for the vertices. They differ in what is an element (a triangle, a
// vertex's triangles, a tetrahedron) and in what M may be: the identity, a rotation, a similarity.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "elements.h"
#include "given.h"
#include "held_points.h"
#include "holds.h"
#include "laplacian_system.h"
#include "measures.h"
#include "pool.h"
#include "preparation.h"
#include "stopwatch.h"
#include "swage/deform.h"

namespace swage {

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
  LaplacianSystem system = {};
  double mean_edge_length = 0;
  int components = 1, flat_triangles = 0;
  std::string told_components = "one", told_filling = {};
  double prepare_seconds = 0;
  bool prepared = false;

  std::mutex preparing = {};
  LastHeld last_held = {};
  Pool<DeformSteps> workspaces = {};
};

// check.cpp
void check_options(const DeformOptions& options);
void check_start(const DeformResult& start, const Mesh& mesh);

// prepare.cpp
std::unique_ptr<DeformPlan> plan_of(Mesh mesh, const DeformOptions& options);
/// Once. False where `progress` cancelled: another call begins anew.
bool prepare(DeformPlan& plan, const ProgressFn& progress);

// energy.cpp
/// Of holds that are not met exactly.
double hold_energy(const DeformOptions& options, const std::vector<Hold>& holds, const Positions& positions);

}  // namespace swage
