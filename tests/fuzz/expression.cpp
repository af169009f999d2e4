// Expressions of parameters, as template files hold them.
#include "expression.h"

#include <cmath>

#include "cpu_steps.h"
#include "fuzz.h"

namespace swage::fuzz {
namespace {

bool are_same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

}  // namespace

void use(std::string_view bytes) {
  const std::vector<double> defaults = {0.5, -3};
  TapeBuilder builder(defaults);
  const auto named = [&](std::string_view name) {
    if (name != "a" && name != "b") throw ExpressionError{"no such parameter"};
    return builder.parameter(name == "a" ? 0 : 1);
  };
  Scalar value{};
  try {
    value = parse_expression(bytes, builder, named);
  } catch (const ExpressionError& refusal) {
    return require(!refusal.what.empty(), "a refusal says why");
  }
  FieldValues field;
  cpu_field(builder.tape(value))
      ->evaluate(Positions::Zero(1, 3), Eigen::Vector2d(defaults[0], defaults[1]), FieldDerivatives::none, field);
  require(are_same(field.values[0], builder.by_default(value)), "the tape's value is the builder's");
}

}  // namespace swage::fuzz
