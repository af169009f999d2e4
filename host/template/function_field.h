// A field that is any function of a point.
#pragma once

#include <vector>

#include "swage/template.h"

namespace swage {

/// Its derivatives are central differences.
class FunctionField : public FieldStep {
 public:
  FunctionField(FieldFunction function, std::vector<TemplateParameter> parameters);

  /// Throws InvalidInput where the function gives another number of values than there are points.
  void evaluate(const Positions& points, const Eigen::VectorXd& parameters, FieldDerivatives derivatives,
                FieldValues& field) override;

 private:
  Eigen::VectorXd values_at(const Positions& points, const Eigen::VectorXd& parameters) const;

  FieldFunction function_;
  std::vector<TemplateParameter> parameters_;
};

}  // namespace swage
