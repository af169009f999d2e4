#include "template_json.h"

namespace swage::cli {

Json values_json(const Template& of, const Eigen::VectorXd& values) {
  Json json = Json::object();
  for (size_t i = 0; i < of.parameters().size(); ++i) {
    json[of.parameters()[i].name] = values[static_cast<Eigen::Index>(i)];
  }
  return json;
}

Json pose_json(const TemplatePose& pose) {
  Json rotation = Json::array();
  for (const auto& row : pose.rotation.rowwise()) rotation.push_back({row[0], row[1], row[2]});
  return {{"scale", pose.scale}, {"rotation", rotation}, {"offset", {pose.offset[0], pose.offset[1], pose.offset[2]}}};
}

}  // namespace swage::cli
