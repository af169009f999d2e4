// A field of space with parameters, as a list of scalar instructions that whoever evaluates it runs through.
#pragma once

#include <vector>

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

}  // namespace swage
