// Arithmetic of parameters, as template files write it: "seat_width / 2 - arm".
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "scalar.h"

namespace swage {

/// What is wrong with an expression, and where: to be completed by who knows the file.
struct ExpressionError {
  std::string what;
};

/// Numbers, names, + - * / with the usual order, parentheses, and functions: min(a, b, ...), max(a, b, ...), abs, sqrt,
/// sin, cos, tan (radians), atan2(y, x), exp, clamp(x, low, high), mix(a, b, weight), radians(degrees); pi.
/// `parameter` gives the value of a name, or throws ExpressionError. Throws ExpressionError.
Scalar parse_expression(std::string_view text, TapeBuilder& builder,
                        const std::function<Scalar(std::string_view)>& parameter);

/// Letters, digits and underscores, no digit first, and no function's name.
bool is_parameter_name(std::string_view name);

}  // namespace swage
