// What a prepared stylization keeps, and the verbs that solve() is told in.
//
// It minimises sum over elements n of [sum over their edges p of w_p |R_n e0_p - e_p|² + lambda a_n |R_n n_n - t_n|²]
// (eq. 3), e0 the edge at rest, n the rest normal, t the target of the normal: each pass the rotations for the vertices
// and targets, then the vertices for the rotations, then the targets for the vertices.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "adjacency.h"
#include "element_list.h"
#include "given.h"
#include "held_points.h"
#include "laplacian_system.h"
#include "measures.h"
#include "pool.h"
#include "preparation.h"
#include "stopwatch.h"
#include "swage/stylize.h"

namespace swage {

struct StylizeSteps {
  std::unique_ptr<RotationStep> rotation;
  std::unique_ptr<SimilarityStep> similarity;  ///< In its place, of acap with exact scales.
};

/// What the local step finds.
struct StylizeFit {
  Transforms matrices;     ///< #N × 9: s R
  Eigen::VectorXd scales;  ///< #N: s; 1 but for acap.
};

struct StylizePlan {
  StylizeOptions options;
  std::optional<Given> given;  ///< Where what follows is not as given.
  Mesh mesh;                   ///< Mesh units.
  SurfaceCounts counts;
  UnitBox box;
  Edges edges;

  // Filled by prepare(), in the unit box.
  Elements elements = {};
  Lists triangles_around = {};  ///< Each vertex.
  std::vector<int> component = {};
  std::vector<int> anchors = {};  ///< Of each component a vertex.
  LaplacianSystem system = {};
  int flat_triangles = 0;
  double prepare_seconds = 0;
  bool prepared = false;

  std::mutex preparing = {};
  LastHeld last_held = {};
  Pool<StylizeSteps> workspaces = {};

  bool of_triangles() const { return options.energy == StylizeEnergy::farap; }
};

// check.cpp
void check_options(const StylizeOptions& options);
void check_style(const StylizePlan& plan, const Style& style, double lambda);
void check_closest(const char* caller, const ClosestNormals& style);

// prepare.cpp
/// Errors name the caller.
std::unique_ptr<StylizePlan> plan_of(Mesh mesh, const StylizeOptions& options, const char* caller = "Stylize");
/// Once. False where `progress` cancelled: another call begins anew.
bool prepare(StylizePlan& plan, const ProgressFn& progress);
/// Takes positions in the unit box for those at rest. Nobody else may use the plan.
void renew(StylizePlan& plan, const Positions& positions);

// hold.cpp
/// Of each component whether it has a handle.
std::vector<char> held_components(const StylizePlan& plan, const Gesture& handles);
/// The handles, and of components without any their anchors. In the unit box.
HeldPoints points_held(const StylizePlan& plan, const Gesture& handles);

// fit.cpp
std::unique_ptr<StylizeSteps> steps_of(const StylizePlan& plan);
std::unique_ptr<NormalFitStep> normal_fit_of(const StylizePlan& plan);
StylizeFit unmoved(Eigen::Index element_count);
/// The local step, from what it found before.
void fit(const StylizePlan& plan, StylizeSteps& steps, const Positions& positions, const Positions& targets,
         double lambda, StylizeFit& fitted);

// energy.cpp
/// In the unit box.
StylizeTerms energy(const StylizePlan& plan, const Positions& positions, const Positions& targets,
                    const StylizeFit& fitted);

}  // namespace swage
