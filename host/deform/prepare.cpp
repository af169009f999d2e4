// All that depends on the rest shape alone.
#include <algorithm>
#include <utility>

#include "flat.h"
#include "inside.h"
#include "join.h"
#include "plan.h"
#include "spokes_and_rims.h"
#include "swage/error.h"
#include "tied_elements.h"

namespace swage {
namespace {

/// Around and within the mesh; where its triangles cannot be faces, of its vertices alone.
Scaffold scaffold_around(DeformPlan& plan, const Mesh& unit_mesh, const Poll& poll) {
  const ProgressFn progress = [&](const Progress&) {
    ask(poll);
    return true;
  };
  ScaffoldOptions options;
  options.leave_out_crossing = true;
  options.time_limit = plan.options.filling_time_limit;
  try {
    return scaffold(unit_mesh.positions, unit_mesh.triangles, options, progress);
  } catch (const Unsolvable& why) {
    plan.told_filling = std::string(", not along its triangles: ") + why.what();
  }
  options.faces = false;
  try {
    return scaffold(unit_mesh.positions, unit_mesh.triangles, options, progress);
  } catch (const Unsolvable& why) {
    throw Unsolvable(std::string("Deform: no filling can be had: ") + why.what() + "; take arap, which needs none");
  }
}

/// The tetrahedra within the mesh, and their vertices behind `vertices`, of which the mesh's are the first.
Tetrahedra filling(DeformPlan& plan, const Mesh& unit_mesh, Positions& vertices, const Poll& poll) {
  const Scaffold all = scaffold_around(plan, unit_mesh, poll);
  const std::vector<char> inside = are_inside(unit_mesh, all.positions, all.tetrahedra, poll);
  std::vector<int> within;
  for (int t = 0; t < all.tetrahedra.rows(); ++t) {
    if (inside[static_cast<size_t>(t)] != 0) within.push_back(t);
  }
  plan.told_filling = std::to_string(within.size()) + " tetrahedra within" + plan.told_filling;
  const auto own = static_cast<int>(unit_mesh.positions.rows()), joined = static_cast<int>(vertices.rows());
  const Eigen::Index further = all.positions.rows() - own;
  vertices.conservativeResize(joined + further, 3);
  vertices.bottomRows(further) = all.positions.bottomRows(further);
  return all.tetrahedra(within, Eigen::all).unaryExpr([&](int v) { return v < own ? v : joined + v - own; });
}

Elements elements_of(DeformPlan& plan, const Mesh& unit_mesh, const std::vector<char>& is_flat, Positions& vertices,
                     const Poll& poll) {
  switch (plan.options.method) {
    case DeformMethod::poisson:
      return triangle_elements(unit_mesh, Positions::Constant(1, 3, 1 / plan.mean_edge_length));
    case DeformMethod::arap:
    case DeformMethod::conformal:
      return vertex_elements(unit_mesh, is_flat);
    case DeformMethod::arap_volume:
      break;
  }
  const Tetrahedra within = filling(plan, unit_mesh, vertices, poll);
  return tetrahedron_elements(vertices, within, unit_mesh.triangles, is_flat, plan.mean_edge_length);
}

void make(DeformPlan& plan, const ProgressFn& progress) {
  Preparation preparation(progress, plan.options.pass_limit);
  const Poll& poll = preparation.poll();
  const Stopwatch watch(plan.prepare_seconds);
  const Mesh unit_mesh{plan.box.into(plan.mesh.positions), plan.mesh.triangles};
  const std::vector<char> is_flat = flat_triangles(unit_mesh.positions, unit_mesh.triangles);
  const std::vector<int> component = components(unit_mesh.triangles, static_cast<int>(unit_mesh.positions.rows()));
  plan.components = 1 + *std::max_element(component.begin(), component.end());
  plan.flat_triangles = static_cast<int>(std::count(is_flat.begin(), is_flat.end(), 1));
  plan.mean_edge_length = mean_edge_length(unit_mesh.positions, unit_mesh.triangles);
  preparation.begin("components", 0);
  const Joined joined = join_components(unit_mesh, plan.edges, plan.options.scaffold, poll);
  plan.told_components = joined.told;
  Positions vertices = joined.scaffold ? joined.scaffold->positions : unit_mesh.positions;
  preparation.begin("elements", 0.2);
  plan.elements = elements_of(plan, unit_mesh, is_flat, vertices, poll);
  add_ties(vertices, joined.ties, plan.mean_edge_length, plan.elements);
  preparation.begin("system", 0.7);
  plan.system = LaplacianSystem(plan.elements.pairs);
}

}  // namespace

std::unique_ptr<DeformPlan> plan_of(Mesh mesh, const DeformOptions& options) {
  Surface surface = surface_given(mesh, "Deform");
  const SurfaceCounts counts = surface.counts;
  std::optional<Given> given;
  if (!surface.is_as_given()) given.emplace(std::move(mesh), surface, false);
  DeformOptions own = options;
  if (!own.backend) own.backend = cpu_backend();
  const UnitBox box = unit_box(surface.mesh.positions);
  return std::unique_ptr<DeformPlan>(
      new DeformPlan{std::move(own), std::move(given), std::move(surface.mesh), counts, box, std::move(surface.edges)});
}

bool prepare(DeformPlan& plan, const ProgressFn& progress) {
  return prepare_once(plan, [&](DeformPlan& unprepared) { make(unprepared, progress); });
}

}  // namespace swage
