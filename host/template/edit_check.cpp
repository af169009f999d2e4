// What cannot be edited is refused, in words.
#include <cmath>

#include "edit_plan.h"
#include "messages.h"
#include "swage/error.h"

namespace swage {

void check_options(const TemplateEditOptions& options) {
  const auto refuse_unless = [](bool fits, const char* option, double value, const char* range) {
    if (fits) return;
    throw InvalidInput(std::string("TemplateEdit: options.") + option + ": " + digits(value) + " is not " + range);
  };
  refuse_unless(options.tracking > 0 && std::isfinite(options.tracking), "tracking", options.tracking,
                "finite and above 0");
  refuse_unless(options.smoothing >= 0 && std::isfinite(options.smoothing), "smoothing", options.smoothing,
                "finite and at least 0");
  refuse_unless(options.feature_angle > 0 && options.feature_angle <= 180, "feature_angle", options.feature_angle,
                "in (0, 180]");
  refuse_unless(options.sub_edits >= 0, "sub_edits", options.sub_edits, "at least 0");
  refuse_unless(options.passes >= 1, "passes", options.passes, "at least 1");
  refuse_unless(options.tolerance > 0 && options.tolerance < 1, "tolerance", options.tolerance, "in (0, 1)");
}

void check_parameters(const Template& of, const Eigen::VectorXd& parameters, const char* called) {
  const std::string begin = std::string("TemplateEdit: ") + called + ": ";
  const auto due = static_cast<Eigen::Index>(of.parameters().size());
  if (parameters.size() != due) {
    throw InvalidInput(begin + std::to_string(parameters.size()) + " parameters, but " + of.name() + " has " +
                       std::to_string(due) + "; give one value for each");
  }
  for (Eigen::Index i = 0; i < due; ++i) {
    if (std::isfinite(parameters[i])) continue;
    throw InvalidInput(begin + of.parameters()[static_cast<size_t>(i)].name + " is not finite; mend it");
  }
}

}  // namespace swage
