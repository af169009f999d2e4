// All that depends on the rest shape alone.
#include <algorithm>
#include <utility>

#include "element_normals.h"
#include "flat.h"
#include "intrinsic_delaunay.h"
#include "plan.h"
#include "spokes_and_rims.h"

namespace swage {
namespace {

Elements elements_of(const StylizePlan& plan, const Mesh& unit_mesh, const std::vector<char>& is_flat) {
  if (plan.options.weights == StylizeWeights::intrinsic_delaunay) {
    const auto [triangles, lengths] = intrinsic_delaunay(unit_mesh, plan.edges, is_flat);
    return vertex_elements({unit_mesh.positions, triangles}, half_cotangents(lengths, is_flat));
  }
  Positions weights = half_cotangents(unit_mesh.positions, unit_mesh.triangles, is_flat);
  if (plan.options.weights == StylizeWeights::clamped) weights = weights.cwiseMax(0);
  return plan.of_triangles() ? triangle_elements(unit_mesh, weights) : vertex_elements(unit_mesh, weights);
}

Eigen::VectorXd areas_of_elements(const StylizePlan& plan, const Mesh& unit_mesh) {
  if (!plan.of_triangles()) return barycentric_areas(unit_mesh.positions, unit_mesh.triangles);
  return area_vectors(unit_mesh.positions, unit_mesh.triangles).rowwise().norm() / 2;
}

/// Of each component the first vertex of its first triangle: the authors' F(0, 0).
std::vector<int> anchors_of(const Mesh& mesh, const std::vector<int>& component) {
  std::vector<int> anchors(static_cast<size_t>(1 + *std::max_element(component.begin(), component.end())), -1);
  for (const auto& triangle : mesh.triangles.rowwise()) {
    int& anchor = anchors[static_cast<size_t>(component[static_cast<size_t>(triangle[0])])];
    if (anchor < 0) anchor = triangle[0];
  }
  return anchors;
}

void find_elements(StylizePlan& plan, const Mesh& unit_mesh) {
  const std::vector<char> is_flat = flat_triangles(unit_mesh.positions, unit_mesh.triangles);
  plan.flat_triangles = static_cast<int>(std::count(is_flat.begin(), is_flat.end(), 1));
  plan.elements = elements_of(plan, unit_mesh, is_flat);
  plan.elements.pairs.normals = element_normals(plan, unit_mesh.positions);
  plan.elements.pairs.normal_weights = areas_of_elements(plan, unit_mesh);
}

void make(StylizePlan& plan, const ProgressFn& progress) {
  Preparation preparation(progress, plan.options.pass_limit);
  const Stopwatch watch(plan.prepare_seconds);
  const Mesh unit_mesh{plan.box.into(plan.mesh.positions), plan.mesh.triangles};
  const auto vertex_count = static_cast<int>(unit_mesh.positions.rows());
  plan.component = components(unit_mesh.triangles, vertex_count);
  plan.anchors = anchors_of(unit_mesh, plan.component);
  plan.triangles_around = triangles_of_vertices(unit_mesh.triangles, vertex_count);
  preparation.begin("elements", 0);
  find_elements(plan, unit_mesh);
  preparation.begin("system", 0.3);
  plan.system = LaplacianSystem(plan.elements.pairs);
  preparation.begin("factor", 0.5);
  held_laplacian(plan.last_held, plan.system, points_held(plan, {}), plan.given, "Stylize");
}

}  // namespace

std::unique_ptr<StylizePlan> plan_of(Mesh mesh, const StylizeOptions& options, const char* caller) {
  Surface surface = surface_given(mesh, caller);
  const SurfaceCounts counts = surface.counts;
  std::optional<Given> given;
  if (!surface.is_as_given()) given.emplace(std::move(mesh), surface, false);
  StylizeOptions own = options;
  if (!own.backend) own.backend = cpu_backend();
  const UnitBox box = unit_box(surface.mesh.positions);
  return std::unique_ptr<StylizePlan>(new StylizePlan{std::move(own), std::move(given), std::move(surface.mesh), counts,
                                                      box, std::move(surface.edges)});
}

bool prepare(StylizePlan& plan, const ProgressFn& progress) {
  return prepare_once(plan, [&](StylizePlan& unprepared) { make(unprepared, progress); });
}

void renew(StylizePlan& plan, const Positions& positions) {
  find_elements(plan, {positions, plan.mesh.triangles});
  plan.system = LaplacianSystem(plan.elements.pairs);
}

}  // namespace swage
