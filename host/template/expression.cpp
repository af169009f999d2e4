#include "expression.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <vector>

namespace swage {
namespace {

using Arguments = std::vector<Scalar>;

struct Function {
  std::string_view name;
  std::size_t least, most;  // Arguments.
  Scalar (*apply)(const Arguments&);
};

constexpr std::size_t kMany = 64;

Scalar least(const Arguments& a) {
  Scalar result = a[0];
  for (const Scalar other : a) result = min(result, other);
  return result;
}

Scalar most(const Arguments& a) {
  Scalar result = a[0];
  for (const Scalar other : a) result = max(result, other);
  return result;
}

constexpr std::array<Function, 12> kFunctions = {{
    {"min", 2, kMany, least},
    {"max", 2, kMany, most},
    {"abs", 1, 1, [](const Arguments& a) { return abs(a[0]); }},
    {"sqrt", 1, 1, [](const Arguments& a) { return sqrt(a[0]); }},
    {"sin", 1, 1, [](const Arguments& a) { return sin(a[0]); }},
    {"cos", 1, 1, [](const Arguments& a) { return cos(a[0]); }},
    {"tan", 1, 1, [](const Arguments& a) { return sin(a[0]) / cos(a[0]); }},
    {"exp", 1, 1, [](const Arguments& a) { return exp(a[0]); }},
    {"atan2", 2, 2, [](const Arguments& a) { return atan2(a[0], a[1]); }},
    {"clamp", 3, 3, [](const Arguments& a) { return clamp(a[0], a[1], a[2]); }},
    {"mix", 3, 3, [](const Arguments& a) { return mix(a[0], a[1], a[2]); }},
    {"radians", 1, 1, [](const Arguments& a) { return a[0] * (std::numbers::pi / 180); }},
}};

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

const Function* function_named(std::string_view name) {
  const auto* const found =
      std::find_if(kFunctions.begin(), kFunctions.end(), [&](const Function& f) { return f.name == name; });
  return found == kFunctions.end() ? nullptr : found;
}

class Parser {
 public:
  Parser(std::string_view text, TapeBuilder& builder, const std::function<Scalar(std::string_view)>& parameter)
      : text_(text), builder_(builder), parameter_(parameter) {}

  Scalar whole() {
    const Scalar result = sum();
    if (next() != '\0') refuse("an operator or the end is expected");
    return result;
  }

 private:
  static constexpr int kDeepest = 100;

  [[noreturn]] void refuse(const std::string& what) const {
    const std::string at = at_ < text_.size() ? "at '" + std::string(text_.substr(at_)) + "'" : "at the end";
    throw ExpressionError{"'" + std::string(text_) + "': " + what + " " + at + "; mend it"};
  }

  /// The next character that is no blank; 0 at the end.
  char next() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool take(char c) {
    if (next() != c) return false;
    ++at_;
    return true;
  }
  void expect(char c) {
    if (!take(c)) refuse(std::string("'") + c + "' is expected");
  }

  Scalar sum() {
    if (++depth_ > kDeepest) refuse("parentheses are nested too deep");
    Scalar result = product();
    while (true) {
      if (take('+')) {
        result = result + product();
      } else if (take('-')) {
        result = result - product();
      } else {
        --depth_;
        return result;
      }
    }
  }

  Scalar product() {
    Scalar result = factor();
    while (true) {
      if (take('*')) {
        result = result * factor();
      } else if (take('/')) {
        result = result / factor();
      } else {
        return result;
      }
    }
  }

  Scalar factor() {
    bool is_negative = false;
    while (take('-')) is_negative = !is_negative;
    const Scalar value = operand();
    return is_negative ? -value : value;
  }

  Scalar operand() {
    const char c = next();
    if (take('(')) {
      const Scalar inner = sum();
      expect(')');
      return inner;
    }
    if (is_digit(c) || c == '.') return number();
    if (is_letter(c)) return named();
    refuse("a number, a name or '(' is expected");
  }

  Scalar number() {
    double value = 0;
    const char* const begin = text_.data() + at_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
    if (error != std::errc() || !std::isfinite(value)) refuse("a number is expected");
    at_ += static_cast<std::size_t>(end - begin);
    return builder_.constant(value);
  }

  Scalar named() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]))) ++at_;
    const std::string_view name = text_.substr(begin, at_ - begin);
    if (name == "pi") return builder_.constant(std::numbers::pi);
    const Function* const function = function_named(name);
    if (function == nullptr) return parameter_(name);
    expect('(');
    Arguments arguments = {sum()};
    while (take(',')) arguments.push_back(sum());
    expect(')');
    if (arguments.size() < function->least || arguments.size() > function->most) {
      refuse(std::string(name) + " takes " + std::to_string(function->least) +
             (function->most == kMany ? " or more" : "") + " arguments, not " + std::to_string(arguments.size()) + ",");
    }
    return function->apply(arguments);
  }

  std::string_view text_;
  TapeBuilder& builder_;
  const std::function<Scalar(std::string_view)>& parameter_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

Scalar parse_expression(std::string_view text, TapeBuilder& builder,
                        const std::function<Scalar(std::string_view)>& parameter) {
  return Parser(text, builder, parameter).whole();
}

bool is_parameter_name(std::string_view name) {
  if (name.empty() || is_digit(name[0]) || name == "pi" || function_named(name) != nullptr) return false;
  return std::all_of(name.begin(), name.end(), [](char c) { return is_letter(c) || is_digit(c); });
}

}  // namespace swage
