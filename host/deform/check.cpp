// What cannot be deformed is refused, in words.
#include <cmath>

#include "plan.h"
#include "swage/error.h"

namespace swage {

const char* to_string(DeformMethod method) {
  switch (method) {
    case DeformMethod::poisson:
      return "poisson";
    case DeformMethod::arap_volume:
      return "arap-volume";
    case DeformMethod::conformal:
      return "conformal";
    case DeformMethod::arap:
      break;
  }
  return "arap";
}

void check_options(const DeformOptions& options) {
  const auto is_above_0 = [](double value) { return value > 0 && std::isfinite(value); };
  if (options.handle_weight && !is_above_0(*options.handle_weight)) {
    throw InvalidInput("Deform: options.handle_weight: not finite and above 0");
  }
  if (options.pass_limit < 1) throw InvalidInput("Deform: options.pass_limit: below 1");
  if (!is_above_0(options.movement)) throw InvalidInput("Deform: options.movement: not finite and above 0");
  if (options.acceleration_window < 0 || options.acceleration_window > 50) {
    throw InvalidInput("Deform: options.acceleration_window: not in [0, 50]");
  }
  if (!is_above_0(options.filling_time_limit)) {
    throw InvalidInput("Deform: options.filling_time_limit: not finite and above 0");
  }
}

void check_start(const DeformResult& start, const Mesh& mesh) {
  if (start.positions.rows() != mesh.positions.rows()) {
    throw InvalidInput("Deform::solve: start.positions: " + std::to_string(start.positions.rows()) +
                       " rows, but the mesh has " + std::to_string(mesh.positions.rows()) + " vertices");
  }
  if (!start.positions.allFinite()) throw InvalidInput("Deform::solve: start.positions: not finite");
}

}  // namespace swage
