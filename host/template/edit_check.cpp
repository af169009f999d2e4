// What cannot be edited is refused, in words.
#include <cmath>

#include "edit_plan.h"
#include "swage/error.h"

namespace swage {

void check_options(const TemplateEditOptions& options) {
  const auto refuse_unless = [](bool fits, const std::string& what) {
    if (!fits) throw InvalidInput("TemplateEdit: options." + what);
  };
  refuse_unless(options.tracking > 0 && std::isfinite(options.tracking), "tracking: not finite and above 0");
  refuse_unless(options.smoothing >= 0 && std::isfinite(options.smoothing), "smoothing: not finite and at least 0");
  refuse_unless(options.feature_angle > 0 && options.feature_angle <= 180, "feature_angle: not in (0, 180]");
  refuse_unless(options.sub_edits >= 0, "sub_edits: below 0");
  refuse_unless(options.passes >= 1, "passes: below 1");
  refuse_unless(options.tolerance > 0 && options.tolerance < 1, "tolerance: not in (0, 1)");
}

void check_parameters(const Template& of, const Eigen::VectorXd& parameters, const char* called) {
  const std::string begin = std::string("TemplateEdit: ") + called + ": ";
  const auto due = static_cast<Eigen::Index>(of.parameters().size());
  if (parameters.size() != due) {
    throw InvalidInput(begin + std::to_string(parameters.size()) + " parameters, but " + of.name() + " has " +
                       std::to_string(due));
  }
  for (Eigen::Index i = 0; i < due; ++i) {
    if (std::isfinite(parameters[i])) continue;
    throw InvalidInput(begin + of.parameters()[static_cast<size_t>(i)].name + " is not finite");
  }
}

}  // namespace swage
