// What cannot be stylized is refused, in words.
#include <cmath>
#include <string>

#include "plan.h"
#include "swage/error.h"

namespace swage {
namespace {

[[noreturn]] void refuse(const char* field, const std::string& why, const char* caller = "Stylize::solve") {
  throw InvalidInput(std::string(caller) + ": style." + field + ": " + why);
}

void check_rows_of(const char* field, const Positions& normals, Eigen::Index rows, const char* of_what) {
  if (normals.rows() == rows) return;
  refuse(field, std::to_string(normals.rows()) + " rows, but there are " + std::to_string(rows) + " " + of_what);
}

void check_directions(const char* field, const Positions& normals, const char* caller = "Stylize::solve") {
  for (Eigen::Index i = 0; i < normals.rows(); ++i) {
    if (!normals.row(i).allFinite()) refuse(field, "row " + std::to_string(i) + " is not finite", caller);
    if (normals.row(i).isZero(0)) refuse(field, "row " + std::to_string(i) + " has no direction", caller);
  }
}

void check_sphere(const SphereMap& map) {
  if (map.directions.rows() == 0) refuse("directions", "there is none");
  check_rows_of("normals", map.normals, map.directions.rows(), "directions");
  check_directions("directions", map.directions);
  check_directions("normals", map.normals);
  if (map.nearest) return;
  if (map.triangles.rows() == 0) refuse("triangles", "there is none");
  if (map.triangles.minCoeff() < 0 || map.triangles.maxCoeff() >= map.directions.rows()) {
    refuse("triangles", "an index is outside [0, " + std::to_string(map.directions.rows()) + ")");
  }
}

}  // namespace

const char* to_string(StylizeEnergy energy) {
  switch (energy) {
    case StylizeEnergy::farap:
      return "farap";
    case StylizeEnergy::acap:
      return "acap";
    case StylizeEnergy::arap:
      break;
  }
  return "arap";
}

const char* to_string(StylizeWeights weights) {
  switch (weights) {
    case StylizeWeights::clamped:
      return "clamped";
    case StylizeWeights::intrinsic_delaunay:
      return "intrinsic delaunay";
    case StylizeWeights::cotangent:
      break;
  }
  return "cotangent";
}

void check_options(const StylizeOptions& options) {
  if (options.weights == StylizeWeights::intrinsic_delaunay && options.energy == StylizeEnergy::farap) {
    throw InvalidInput("Stylize: options.weights: intrinsic_delaunay is not for farap: take clamped");
  }
  if (options.acceleration_window < 0 || options.acceleration_window > 50) {
    throw InvalidInput("Stylize: options.acceleration_window: not in [0, 50]");
  }
  if (options.pass_limit < 1) throw InvalidInput("Stylize: options.pass_limit: below 1");
  if (!(options.movement >= 0 && std::isfinite(options.movement))) {
    throw InvalidInput("Stylize: options.movement: not finite and at least 0");
  }
}

void check_closest(const char* caller, const ClosestNormals& style) {
  if (style.normals.rows() == 0) refuse("normals", "there is none", caller);
  check_directions("normals", style.normals, caller);
}

void check_style(const StylizePlan& plan, const Style& style, double lambda) {
  if (!(lambda >= 0 && std::isfinite(lambda))) throw InvalidInput("Stylize::solve: lambda: not finite and at least 0");
  if (const auto* closest = std::get_if<ClosestNormals>(&style)) check_closest("Stylize::solve", *closest);
  if (const auto* normals = std::get_if<GivenNormals>(&style)) {
    const Mesh& mesh = plan.given ? plan.given->mesh() : plan.mesh;
    const Eigen::Index due = normals->of_triangles ? mesh.triangles.rows() : mesh.positions.rows();
    check_rows_of("normals", normals->normals, due, normals->of_triangles ? "triangles" : "vertices");
    if (!normals->normals.allFinite()) refuse("normals", "not finite");
  }
  if (const auto* map = std::get_if<SphereMap>(&style)) check_sphere(*map);
  if (const auto* developable = std::get_if<Developable>(&style)) {
    if (!(developable->tau >= 0 && std::isfinite(developable->tau))) refuse("tau", "not finite and at least 0");
    if (!(developable->threshold >= 0 && std::isfinite(developable->threshold))) {
      refuse("threshold", "not finite and at least 0");
    }
  }
}

}  // namespace swage
