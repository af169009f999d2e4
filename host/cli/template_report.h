// What `swage template` tells of templates and runs, in numbers.
#pragma once

#include <string>

#include "report_json.h"
#include "swage/template_fit.h"

namespace swage::cli {

/// A line a parameter: name, value, range, group and description.
std::string table_of(const Template& of, const Eigen::VectorXd& values);

/// How far the template is off the mesh, and the parameters that stand at a bound.
void add_fit_quality(Json& json, const Template& of, const TemplateFit& fit, std::vector<std::string>& warnings);

}  // namespace swage::cli
