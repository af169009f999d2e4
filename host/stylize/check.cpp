// What cannot be stylized is refused, in words.
#include <cmath>
#include <string>

#include "plan.h"
#include "swage/error.h"

namespace swage {
namespace {

[[noreturn]] void refuse(const char* field, const std::string& why) {
  throw InvalidInput("Stylize::solve: style." + std::string(field) + ": " + why);
}

void check_rows_of(const char* field, const Positions& normals, Eigen::Index rows, const char* of_what) {
  if (normals.rows() == rows) return;
  refuse(field, std::to_string(normals.rows()) + " rows, but there are " + std::to_string(rows) + " " + of_what);
}

void check_directions(const char* field, const Positions& normals) {
  for (Eigen::Index i = 0; i < normals.rows(); ++i) {
    if (!normals.row(i).allFinite()) refuse(field, "row " + std::to_string(i) + " is not finite");
    if (normals.row(i).isZero(0)) refuse(field, "row " + std::to_string(i) + " has no direction");
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

void check_options(const StylizeOptions& options) {
  if (options.pass_limit < 1) throw InvalidInput("Stylize: options.pass_limit: below 1");
  if (!(options.movement >= 0 && std::isfinite(options.movement))) {
    throw InvalidInput("Stylize: options.movement: not finite and at least 0");
  }
}

void check_style(const StylizePlan& plan, const Style& style, double lambda) {
  if (!(lambda >= 0 && std::isfinite(lambda))) throw InvalidInput("Stylize::solve: lambda: not finite and at least 0");
  if (const auto* closest = std::get_if<ClosestNormals>(&style)) {
    if (closest->normals.rows() == 0) refuse("normals", "there is none");
    check_directions("normals", closest->normals);
  }
  if (const auto* normals = std::get_if<GivenNormals>(&style)) {
    const Mesh& mesh = plan.given ? plan.given->mesh() : plan.mesh;
    const Eigen::Index due = normals->of_triangles ? mesh.triangles.rows() : mesh.positions.rows();
    check_rows_of("normals", normals->normals, due, normals->of_triangles ? "triangles" : "vertices");
    if (!normals->normals.allFinite()) refuse("normals", "not finite");
  }
  if (const auto* map = std::get_if<SphereMap>(&style)) check_sphere(*map);
  if (const auto* developable = std::get_if<Developable>(&style)) {
    if (!(developable->tau >= 0 && developable->tau <= 0.5)) refuse("tau", "not in [0, 1/2]");
    if (!(developable->threshold >= 0 && std::isfinite(developable->threshold))) {
      refuse("threshold", "not finite and at least 0");
    }
  }
}

}  // namespace swage
