// A template's parameters and place as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "swage/template_fit.h"

namespace swage::cli {

using Json = nlohmann::ordered_json;

/// An object with the values by their names.
Json values_json(const Template& of, const Eigen::VectorXd& values);

Json pose_json(const TemplatePose& pose);

}  // namespace swage::cli
