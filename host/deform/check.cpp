// What cannot be deformed is refused, in words.
#include <cmath>

#include "messages.h"
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
  const auto refuse_unless = [](bool fits, const char* option, double value, const char* range) {
    if (!fits) throw InvalidInput(std::string("Deform: options.") + option + ": " + digits(value) + " is not " + range);
  };
  if (options.handle_weight) {
    refuse_unless(is_above_0(*options.handle_weight), "handle_weight", *options.handle_weight, "finite and above 0");
  }
  refuse_unless(options.pass_limit >= 1, "pass_limit", options.pass_limit, "at least 1");
  refuse_unless(is_above_0(options.movement), "movement", options.movement, "finite and above 0");
  refuse_unless(options.acceleration_window >= 0 && options.acceleration_window <= 50, "acceleration_window",
                options.acceleration_window, "in [0, 50]");
  refuse_unless(is_above_0(options.filling_time_limit), "filling_time_limit", options.filling_time_limit,
                "finite and above 0");
}

void check_start(const DeformResult& start, const Mesh& mesh) {
  if (start.positions.rows() != mesh.positions.rows()) {
    throw InvalidInput("Deform::solve: start.positions: " + std::to_string(start.positions.rows()) +
                       " rows, but the mesh has " + std::to_string(mesh.positions.rows()) +
                       " vertices; give one for each");
  }
  if (const Eigen::Index row = first_not_finite(start.positions); row >= 0) {
    throw InvalidInput("Deform::solve: start.positions: row " + std::to_string(row) + " is not finite; mend it");
  }
}

}  // namespace swage
