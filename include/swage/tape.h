// A field of space with parameters, as a list of scalar instructions that whoever evaluates it runs through.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#pragma GCC visibility push(default)
namespace swage {

/// Of arguments a and, where there are two, b. Where a derivative does not exist, that of one side is taken, or 0.
enum class TapeOp : unsigned char {
  add,
  subtract,
  multiply,
  divide,
  minimum,
  maximum,
  arctangent,  ///< atan2(a, b), 0 at the origin
  less,        ///< 1 where a < b, else 0
  negate,
  absolute,
  root,  ///< sqrt(max(a, 0)), with derivative 0 where a <= 0
  sine,
  cosine,
  exponential,
  floor,
};

/// Whether there is an argument b.
constexpr bool is_binary(TapeOp op) { return op <= TapeOp::less; }

struct TapeInstruction {
  TapeOp op;
  int a, b;  ///< Slots; of unary ones b is a.
};

/// Values stand in slots: parameters, constants, one for each instruction of `setup`, then x, y, z and one for each
/// instruction of `body`. Instructions read only slots before their own.
struct Tape {
  int parameter_count = 0;
  std::vector<double> constants;
  std::vector<TapeInstruction> setup;  ///< Of parameters alone: once for all points.
  std::vector<TapeInstruction> body;   ///< Of each point.
  int root = 0;                        ///< The slot of the field's value.

  int uniform_count() const { return parameter_count + static_cast<int>(constants.size() + setup.size()); }
  int slot_count() const { return uniform_count() + 3 + static_cast<int>(body.size()); }
};

inline double value_of(TapeOp op, double a, double b) {
  switch (op) {
    case TapeOp::add:
      return a + b;
    case TapeOp::subtract:
      return a - b;
    case TapeOp::multiply:
      return a * b;
    case TapeOp::divide:
      return a / b;
    case TapeOp::minimum:
      return std::min(a, b);
    case TapeOp::maximum:
      return std::max(a, b);
    case TapeOp::arctangent:
      return a == 0 && b == 0 ? 0 : std::atan2(a, b);
    case TapeOp::less:
      return a < b ? 1 : 0;
    case TapeOp::negate:
      return -a;
    case TapeOp::absolute:
      return std::abs(a);
    case TapeOp::root:
      return std::sqrt(std::max(a, 0.0));
    case TapeOp::sine:
      return std::sin(a);
    case TapeOp::cosine:
      return std::cos(a);
    case TapeOp::exponential:
      return std::exp(a);
    case TapeOp::floor:
      return std::floor(a);
  }
  return 0;
}

/// Of an instruction's value by its arguments.
struct TapeSlopes {
  double a = 0, b = 0;
};

inline TapeSlopes slopes_of(TapeOp op, double a, double b, double value) {
  const double square = a * a + b * b;
  switch (op) {
    case TapeOp::add:
      return {1, 1};
    case TapeOp::subtract:
      return {1, -1};
    case TapeOp::multiply:
      return {b, a};
    case TapeOp::divide:
      return {1 / b, -value / b};
    case TapeOp::minimum:
      return a <= b ? TapeSlopes{1, 0} : TapeSlopes{0, 1};
    case TapeOp::maximum:
      return a >= b ? TapeSlopes{1, 0} : TapeSlopes{0, 1};
    case TapeOp::arctangent:
      return square > 0 ? TapeSlopes{b / square, -a / square} : TapeSlopes{};
    case TapeOp::negate:
      return {-1, 0};
    case TapeOp::absolute:
      return {a < 0 ? -1.0 : 1.0, 0};
    case TapeOp::root:
      return {value > 0 ? 0.5 / value : 0, 0};
    case TapeOp::sine:
      return {std::cos(a), 0};
    case TapeOp::cosine:
      return {-std::sin(a), 0};
    case TapeOp::exponential:
      return {value, 0};
    case TapeOp::less:
    case TapeOp::floor:
      return {};
  }
  return {};
}

}  // namespace swage
#pragma GCC visibility pop
