// What a solve's report tells of it.
#include <numbers>
#include <sstream>
#include <string>

#include "coarse.h"
#include "plan.h"
#include "warnings.h"

namespace swage {
namespace {

template <typename Matrix>
std::size_t bytes(const Matrix& matrix) {
  return static_cast<std::size_t>(matrix.size()) * sizeof(typename Matrix::Scalar);
}

std::size_t bytes(const TransformStep::Rest& rest) {
  return bytes(rest.triangles) + bytes(rest.edges) + bytes(rest.triangle_edges) + bytes(rest.pairs) +
         bytes(rest.pair_edges) + bytes(rest.edge_vectors) + bytes(rest.normals) + bytes(rest.pair_opposites) +
         bytes(rest.pair_similarities) + bytes(rest.sphericities) + bytes(rest.vertices);
}

/// Without the backend's.
std::map<std::string, std::size_t> bytes_by_part(const ReshapePlan& plan, const Iterate& iterate) {
  const Workspace& work = iterate.work;
  std::map<std::string, std::size_t> parts;
  parts["rest_shape"] = bytes(*plan.rest);
  parts["transform_system"] = plan.transforms ? plan.transforms->bytes() : plan.multilevel->bytes();
  if (work.transforms) parts["transform_system"] += work.transforms->bytes();
  parts["vertex_system"] = plan.vertices->system.bytes() + work.vertices.bytes();
  parts["iterate"] = bytes(iterate.transforms) + bytes(iterate.right_hand_sides) + bytes(iterate.quadratics.blocks) +
                     bytes(iterate.quadratics.right_hand_sides) + bytes(iterate.quadratics.target_lengths);
  parts["acceleration"] = iterate.acceleration.bytes();
  if (plan.coarse) parts["coarse_start"] = plan.coarse->bytes();
  return parts;
}

std::map<std::string, std::string> paths(const ReshapePlan& plan, const Workspace& work, bool warm) {
  const auto path = [](LinearSolver solver, const std::string& why) {
    return std::string(to_string(solver)) + ": " + why;
  };
  const bool fell_back = work.vertices.system.has_factor() != plan.vertices->system.has_factor();
  std::string start = plan.coarse
                          ? "coarse: of " + std::to_string(plan.coarse->proxy.mesh.triangles.rows()) + " triangles"
                          : "rest: " + plan.paths.why_no_coarse_start;
  if (warm) start = "result: as given";
  return {{"vertex_step", fell_back ? path(LinearSolver::factor, "multigrid did not converge")
                                    : path(plan.paths.vertices, plan.paths.why_vertices)},
          {"transform_step", path(plan.paths.transforms, plan.paths.why_transforms)},
          {"mesh", plan.paths.mesh},
          {"components", plan.paths.components},
          {"start", start}};
}

void warn_of_triangles(const ReshapePlan& plan, Report& report) {
  const ShapeQuality& quality = plan.quality;
  if (!has_needles(quality) && !is_uneven(quality)) return;
  std::ostringstream words;
  words.precision(2);
  words << "triangles are needles or uneven, one in twenty with an angle below "
        << quality.low_angle * 180 / std::numbers::pi << " degrees, the longest edge " << quality.longest_over_mean
        << " times the mean: "
        << (plan.stand_in ? "a remeshed stand-in was solved" : "solved as they are; a remeshed stand-in is better");
  report.warnings.push_back(words.str());
}

}  // namespace

void tell(const ReshapePlan& plan, const Iterate& iterate, bool warm, Report& report) {
  if (report.passes > 0) report.energy_by_term = iterate.energy_by_term[static_cast<size_t>(report.best_pass)];
  report.bytes = bytes_by_part(plan, iterate);
  report.paths.merge(paths(plan, iterate.work, warm));
  report.seconds = iterate.seconds;
  report.seconds["precompute"] = plan.prepare_seconds;
  if (iterate.singular > 0) {
    report.warnings.push_back("in a pass " + std::to_string(iterate.singular) +
                              " triangles were flattened: their transforms were inverted with damping");
  }
}

void warn(const ReshapePlan& plan, const Gesture& gesture, ReshapeResult& result) {
  warn_of_shape({plan.counts, plan.edges, plan.flat_triangles, plan.components}, result.report);
  warn_of_triangles(plan, result.report);
  warn_of_misses(plan.given ? plan.given->mesh() : plan.mesh, gesture, result.positions,
                 "keeping the normals of the surface there resists; move more of it along, or less far", result.report);
}

}  // namespace swage
