#include "template_report.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "template_choice.h"

namespace swage::cli {

std::string table_of(const Template& of, const Eigen::VectorXd& values) {
  size_t name_width = 0, group_width = 0;
  for (const TemplateParameter& parameter : of.parameters()) {
    name_width = std::max(name_width, parameter.name.size());
    group_width = std::max(group_width, parameter.group.size());
  }
  std::string text;
  for (size_t i = 0; i < of.parameters().size(); ++i) {
    const TemplateParameter& parameter = of.parameters()[i];
    text += fmt::format("  {:<{}}  {:>10}  {:>8} to {:<8}  {:<{}}  {}\n", parameter.name, name_width,
                        number_words(values[static_cast<Eigen::Index>(i)]), number_words(parameter.least),
                        number_words(parameter.most), parameter.group, group_width, parameter.description);
  }
  return text;
}

void add_fit_quality(Json& json, const Template& of, const TemplateFit& fit, std::vector<std::string>& warnings) {
  json["residual"] = finite(fit.residual, "residual", warnings);
  json["excess"] = finite(fit.excess, "excess", warnings);
  json["largest"] = finite(fit.largest, "largest", warnings);
  json["at_bound"] = Json::array();
  for (const int parameter : fit.at_bound) {
    json["at_bound"].push_back(of.parameters()[static_cast<size_t>(parameter)].name);
  }
}

}  // namespace swage::cli
