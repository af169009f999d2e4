// Preparing a plan: all that depends on the rest shape alone.
#include "plan.h"

#include <algorithm>

#include "coarse.h"
#include "element_graphs.h"
#include "flat.h"
#include "join.h"
#include "stand_in.h"

namespace swage {
namespace {

/// The published passes are never others, whatever a build has.
std::optional<FactorKind> factor_kind(const ReshapeOptions& options) {
  if (options.solver == ReshapeSolver::published) return FactorKind::simplicial;
  return std::nullopt;
}

std::optional<FactorKind> vertex_factor_kind(const ReshapePlan& plan) {
  if (plan.paths.vertices == LinearSolver::multigrid) return FactorKind::none;
  return factor_kind(plan.options);
}

void factor_or_coarsen(ReshapePlan& plan, const Poll& poll) {
  if (plan.paths.transforms == LinearSolver::multigrid) {
    const ElementGraph graph = transform_graph(*plan.rest);
    poll();
    plan.multilevel.emplace(graph, poll);
    return;
  }
  BlockSystem transforms = transform_system(*plan.rest, factor_kind(plan.options), poll);
  poll();
  transforms.factor(poll);
  poll();
  if (plan.options.solver == ReshapeSolver::steady && !plan.options.refactor_every_pass) transforms.keep_single();
  plan.transforms = std::move(transforms);
}

/// Tried on the way back to rest from twice the size.
bool multigrid_suits(const ReshapePlan& plan, Workspace& work, const Poll& poll) {
  TransformStep::EdgeQuadratics quadratics;
  work.step->fit_edges(identities(plan.rest->triangles.rows()), quadratics);
  const Holds hold{{Hold::at(0, plan.rest->vertices.row(0))}, plan.weights.handle};
  return place_by_multigrid(work.vertices, *plan.rest, quadratics, plan.bonds, {hold}, 2 * plan.rest->vertices, poll)
      .has_value();
}

/// Joins components that no triangle joins.
void join(ReshapePlan& plan, const Mesh& unit_mesh, TransformStep::Rest& rest, const Poll& poll) {
  Joined joined = join_components(unit_mesh, plan.edges, plan.options.scaffold, poll);
  if (joined.scaffold) {
    rest.vertices = std::move(joined.scaffold->positions);
    plan.scaffold = std::move(joined.scaffold->tetrahedra);
  }
  plan.bonds.ties = std::move(joined.ties);
  plan.paths.components = std::move(joined.told);
}

/// What warnings and the choice of a stand-in go by.
void look_at(ReshapePlan& plan) {
  const auto& [positions, triangles] = plan.mesh;
  const std::vector<int> component = components(triangles, static_cast<int>(positions.rows()));
  const std::vector<char> is_flat = flat_triangles(plan.box.into(positions), triangles);
  plan.components = 1 + *std::max_element(component.begin(), component.end());
  plan.flat_triangles = static_cast<int>(std::count(is_flat.begin(), is_flat.end(), 1));
  plan.quality = shape_quality(positions, triangles);
}

void make(ReshapePlan& plan, const ProgressFn& progress) {
  Preparation preparation(progress, plan.options.pass_limit);
  const Poll& poll = preparation.poll();
  const Stopwatch watch(plan.prepare_seconds);
  look_at(plan);
  plan.stand_in = stand_in_for(plan, progress, plan.paths.mesh);
  if (plan.stand_in) return;
  const Mesh unit_mesh{plan.box.into(plan.mesh.positions), plan.mesh.triangles};
  preparation.begin("curvature", 0);
  const Curvatures curvatures = plan.options.unit_box_curvatures
                                    ? *plan.options.unit_box_curvatures
                                    : curvature(unit_mesh.positions, unit_mesh.triangles, {}, *plan.options.backend);
  poll();
  plan.weights = step_weights(plan.options, unit_mesh);
  TransformStep::Rest rest = rest_shape(plan.options, unit_mesh, plan.edges, curvatures);
  const std::string mesh = plan.paths.mesh;
  plan.paths =
      choose_paths(plan.options, plan.mesh.positions.rows(), plan.mesh.triangles.rows(), !plan.bonds.straight.empty());
  plan.paths.mesh = mesh;
  plan.bonds.straightness_weight = plan.weights.straightness;
  plan.bonds.firm_length = plan.options.solver == ReshapeSolver::steady ? rest.mean_edge_length : 0;
  preparation.begin("components", 0.15);
  join(plan, unit_mesh, rest, poll);
  plan.rest = std::make_shared<const TransformStep::Rest>(std::move(rest));
  preparation.begin("order", 0.2);
  plan.vertices = vertex_system(*plan.rest, plan.bonds, vertex_factor_kind(plan), poll);
  preparation.begin("factor", 0.4);
  factor_or_coarsen(plan, poll);
  preparation.begin("coarse", 0.8);
  plan.coarse = coarse_plan(plan, curvatures, poll, plan.paths.why_no_coarse_start);
  preparation.begin("workspace", 0.95);
  const auto first =
      plan.workspaces.lend([&] { return workspace(plan, poll); });         // For the first solve, as fast as any.
  if (first->transforms) std::swap(*first->transforms, *plan.transforms);  // It has analysed its pattern.
  if (plan.options.linear_solver == LinearSolver::automatic && plan.paths.vertices == LinearSolver::multigrid &&
      !multigrid_suits(plan, *first, poll)) {
    plan.paths.vertices = LinearSolver::factor;
    plan.paths.why_vertices = "multigrid is slow on these triangles";
    plan.vertices = vertex_system(*plan.rest, plan.bonds, factor_kind(plan.options), poll);
    first->vertices = plan.vertices->unsolved();
  }
}

}  // namespace

std::unique_ptr<Workspace> workspace(const ReshapePlan& plan, const Poll& poll) {
  std::unique_ptr<TransformStep> step = plan.options.backend->transform(plan.rest);
  ask(poll);
  auto work = std::make_unique<Workspace>(Workspace{std::move(step), plan.vertices->unsolved(), {}, {}});
  ask(poll);
  if (plan.multilevel) work->coupling = plan.options.backend->coupling(*plan.rest);
  if (plan.options.refactor_every_pass) work->transforms = plan.transforms->unfactored();
  return work;
}

bool prepare(ReshapePlan& plan, const ProgressFn& progress) {
  return prepare_once(plan, [&](ReshapePlan& unprepared) { make(unprepared, progress); });
}

}  // namespace swage
