// From any list of triangles to a plan for the surface that is solved.
#include "as_given.h"
#include "plan.h"

namespace swage {
namespace {

/// The published solver is never another, whatever rounds in another order.
bool is_worth_an_order(const ReshapeOptions& options, const Mesh& mesh) {
  constexpr Eigen::Index kWorthwhile = 1'000;  // Vertices. All of fewer are in the cache.
  return options.solver == ReshapeSolver::steady && mesh.positions.rows() >= kWorthwhile;
}

}  // namespace

std::unique_ptr<ReshapePlan> plan_of(Mesh mesh, const ReshapeOptions& options) {
  Surface surface = surface_given(mesh, "Reshape");
  const SurfaceCounts counts = surface.counts;
  std::optional<Given> given;
  const bool in_order = is_worth_an_order(options, surface.mesh);
  if (in_order || !surface.is_as_given()) given.emplace(std::move(mesh), surface, in_order);
  ReshapeOptions own = given ? into(*given, options) : options;
  if (!own.backend) own.backend = cpu_backend();
  const UnitBox box = unit_box(surface.mesh.positions);
  if (own.find_chains && own.straight_chains.empty()) {
    own.straight_chains = straight_chains(surface.mesh.positions, surface.mesh.triangles, *own.find_chains);
  }
  Bonds bonds{straight_triples(own.straight_chains, surface.edges)};
  return std::unique_ptr<ReshapePlan>(new ReshapePlan{std::move(own), std::move(given), std::move(surface.mesh), counts,
                                                      box, std::move(surface.edges), std::move(bonds)});
}

}  // namespace swage
