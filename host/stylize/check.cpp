// What cannot be stylized is refused, in words.
#include <cmath>
#include <string>

#include "messages.h"
#include "plan.h"
#include "swage/error.h"

namespace swage {
namespace {

[[noreturn]] void refuse(const char* field, const std::string& why, const char* caller = "Stylize::solve") {
  throw InvalidInput(std::string(caller) + ": style." + field + ": " + why);
}

void check_rows_of(const char* field, const Positions& normals, Eigen::Index rows, const char* of_what) {
  if (normals.rows() == rows) return;
  refuse(field, std::to_string(normals.rows()) + " rows, but there are " + std::to_string(rows) + " " + of_what +
                    "; give one for each");
}

void check_directions(const char* field, const Positions& normals, const char* caller = "Stylize::solve") {
  for (Eigen::Index i = 0; i < normals.rows(); ++i) {
    if (!normals.row(i).allFinite()) refuse(field, "row " + std::to_string(i) + " is not finite; mend it", caller);
    if (normals.row(i).isZero(0)) refuse(field, "row " + std::to_string(i) + " has no direction; mend it", caller);
  }
}

void check_sphere(const SphereMap& map) {
  if (map.directions.rows() == 0) refuse("directions", "there is none; give some");
  check_rows_of("normals", map.normals, map.directions.rows(), "directions");
  check_directions("directions", map.directions);
  check_directions("normals", map.normals);
  if (map.nearest) return;
  if (map.triangles.rows() == 0) refuse("triangles", "there is none; give some, or take the nearest (nearest)");
  for (Eigen::Index t = 0; t < map.triangles.rows(); ++t) {
    if (map.triangles.row(t).minCoeff() >= 0 && map.triangles.row(t).maxCoeff() < map.directions.rows()) continue;
    refuse("triangles", "row " + std::to_string(t) + " names none of the " + std::to_string(map.directions.rows()) +
                            " directions; mend it");
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
  const auto refuse_unless = [](bool fits, const char* option, double value, const char* range) {
    if (!fits)
      throw InvalidInput(std::string("Stylize: options.") + option + ": " + digits(value) + " is not " + range);
  };
  refuse_unless(options.acceleration_window >= 0 && options.acceleration_window <= 50, "acceleration_window",
                options.acceleration_window, "in [0, 50]");
  refuse_unless(options.pass_limit >= 1, "pass_limit", options.pass_limit, "at least 1");
  refuse_unless(options.movement >= 0 && std::isfinite(options.movement), "movement", options.movement,
                "finite and at least 0");
}

void check_closest(const char* caller, const ClosestNormals& style) {
  if (style.normals.rows() == 0) refuse("normals", "there is none; give some", caller);
  check_directions("normals", style.normals, caller);
}

void check_style(const StylizePlan& plan, const Style& style, double lambda) {
  if (!(lambda >= 0 && std::isfinite(lambda))) {
    throw InvalidInput("Stylize::solve: lambda: " + digits(lambda) + " is not finite and at least 0");
  }
  if (const auto* closest = std::get_if<ClosestNormals>(&style)) check_closest("Stylize::solve", *closest);
  if (const auto* normals = std::get_if<GivenNormals>(&style)) {
    const Mesh& mesh = plan.given ? plan.given->mesh() : plan.mesh;
    const Eigen::Index due = normals->of_triangles ? mesh.triangles.rows() : mesh.positions.rows();
    check_rows_of("normals", normals->normals, due, normals->of_triangles ? "triangles" : "vertices");
    if (const Eigen::Index row = first_not_finite(normals->normals); row >= 0) {
      refuse("normals", "row " + std::to_string(row) + " is not finite; mend it");
    }
  }
  if (const auto* map = std::get_if<SphereMap>(&style)) check_sphere(*map);
  if (const auto* developable = std::get_if<Developable>(&style)) {
    const auto refuse_unless_at_least_0 = [](const char* field, double value) {
      if (!(value >= 0 && std::isfinite(value))) refuse(field, digits(value) + " is not finite and at least 0");
    };
    refuse_unless_at_least_0("tau", developable->tau);
    refuse_unless_at_least_0("threshold", developable->threshold);
  }
}

}  // namespace swage
