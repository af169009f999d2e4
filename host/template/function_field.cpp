#include "function_field.h"

#include <utility>

#include "swage/error.h"

namespace swage {
namespace {

constexpr double kProbe = 1e-5;

}  // namespace

FunctionField::FunctionField(FieldFunction function, std::vector<TemplateParameter> parameters)
    : function_(std::move(function)), parameters_(std::move(parameters)) {}

Eigen::VectorXd FunctionField::values_at(const Positions& points, const Eigen::VectorXd& parameters) const {
  Eigen::VectorXd values;
  function_(points, parameters, values);
  if (values.size() != points.rows()) {
    throw InvalidInput("FieldFunction: gave " + std::to_string(values.size()) + " values at " +
                       std::to_string(points.rows()) + " points; give one for each");
  }
  return values;
}

void FunctionField::evaluate(const Positions& points, const Eigen::VectorXd& parameters, FieldDerivatives derivatives,
                             FieldValues& field) {
  field.values = values_at(points, parameters);
  if (derivatives == FieldDerivatives::none) return;
  field.gradients.resize(points.rows(), 3);
  for (int u = 0; u < 3; ++u) {
    const Eigen::RowVector3d reach = kProbe * Eigen::RowVector3d::Unit(u);
    field.gradients.col(u) =
        (values_at(points.rowwise() + reach, parameters) - values_at(points.rowwise() - reach, parameters)) /
        (2 * kProbe);
  }
  if (derivatives == FieldDerivatives::in_space) return;
  field.by_parameters.resize(points.rows(), parameters.size());
  for (Eigen::Index i = 0; i < parameters.size(); ++i) {
    const TemplateParameter& p = parameters_[static_cast<std::size_t>(i)];
    Eigen::VectorXd low = parameters, high = parameters;
    low[i] -= kProbe * (p.most - p.least);
    high[i] += kProbe * (p.most - p.least);
    field.by_parameters.col(i) = (values_at(points, high) - values_at(points, low)) / (high[i] - low[i]);
  }
}

}  // namespace swage
