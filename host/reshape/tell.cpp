// What a solve's report tells of it.
#include <numbers>
#include <sstream>
#include <string>

#include "coarse.h"
#include "plan.h"

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

void warn_of_shape(const ReshapePlan& plan, Report& report) {
  const auto warn = [&](int count, const char* one, const char* many, const char* what) {
    if (count == 0) return;
    report.warnings.push_back(std::to_string(count) + " " + (count == 1 ? one : many) + ": " + what);
  };
  const SurfaceCounts& counts = plan.counts;
  warn(counts.merged, "vertex is at another's place", "vertices are at others' places",
       "what is at one place stays so");
  warn(counts.loose, "vertex has no triangle", "vertices have no triangle", "carried by the nearest surface");
  warn(counts.repeated, "triangle repeats another", "triangles repeat others", "left out of the solve");
  warn(counts.collapsed, "triangle has two corners at one place", "triangles have two corners at one place",
       "left out of the solve");
  warn(counts.turned, "triangle winds against its neighbours", "triangles wind against their neighbours",
       "turned for the solve");
  warn(plan.flat_triangles, "triangle has no area", "triangles have no area", "they go with their neighbours");
  const Lists& triangles = plan.edges.triangles;
  int open = 0, crowded = 0;
  for (int e = 0; e < triangles.size(); ++e) {
    open += triangles[e].size() == 1 ? 1 : 0;
    crowded += triangles[e].size() > 2 ? 1 : 0;
  }
  warn(open, "edge has one triangle", "edges have one triangle", "the surface ends there");
  warn(crowded, "edge has more than two triangles", "edges have more than two triangles",
       "each two of them are neighbours");
  warn(plan.components == 1 ? 0 : plan.components, "", "components that no triangle joins",
       "held together where they touch or cross, else joined");
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

void warn_of_misses(const Mesh& mesh, const Gesture& gesture, const Positions& positions, Report& report) {
  constexpr double kFar = 0.01;
  const double diagonal = box_diagonal(mesh.positions);
  int count = 0, worst = -1;
  double most = kFar * diagonal;
  for (const auto& [vertex, target] : gesture.targets) {
    const double miss = (positions.row(vertex).transpose() - target).norm();
    if (miss > kFar * diagonal) ++count;
    if (miss > most) {
      most = miss;
      worst = vertex;
    }
  }
  if (count == 0) return;
  std::ostringstream words;
  words.precision(3);
  words << count << (count == 1 ? " handle" : " handles") << " missed by more than 1 % of the box's diagonal, vertex "
        << worst << " by " << 100 * most / diagonal
        << " %: keeping the normals of the surface there resists; move more of it along, or less far";
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
  warn_of_shape(plan, result.report);
  warn_of_triangles(plan, result.report);
  warn_of_misses(plan.given ? plan.given->mesh() : plan.mesh, gesture, result.positions, result.report);
}

}  // namespace swage
