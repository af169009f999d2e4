// Formulas of tapes, written as C++ writes them.
#pragma once

#include <cstddef>
#include <map>
#include <tuple>
#include <vector>

#include "swage/tape.h"

namespace swage {

class TapeBuilder;

/// Thrown where a field takes more instructions than anyone would wait for. Never leaves the library.
struct TapeTooLong {};

/// A value of a tape that is being built.
struct Scalar {
  TapeBuilder* builder;
  int id;
};

/// Values that are made of the same ones alike are one; those of constants are constants.
class TapeBuilder {
 public:
  /// `defaults`: of each parameter.
  explicit TapeBuilder(const std::vector<double>& defaults);
  TapeBuilder(const TapeBuilder&) = delete;
  TapeBuilder& operator=(const TapeBuilder&) = delete;

  Scalar parameter(int index) { return {this, index}; }
  /// x, y or z.
  Scalar coordinate(int axis) { return {this, parameter_count_ + axis}; }
  Scalar constant(double value);
  Scalar apply(TapeOp op, Scalar a, Scalar b);

  /// Of a value that does not depend on x, y and z.
  double by_default(Scalar value) const { return node(value.id).value; }

  /// Of what the root needs, in the order it was made.
  Tape tape(Scalar root) const;

 private:
  struct Node {
    enum class Kind { parameter, coordinate, constant, made } kind;
    double value;  // By default, where it is not of a point.
    TapeInstruction instruction;
    bool of_point;  // Whether it depends on x, y or z.
  };

  const Node& node(int id) const { return nodes_[static_cast<std::size_t>(id)]; }
  bool is_constant(int id) const { return node(id).kind == Node::Kind::constant; }
  int simplified(TapeOp op, int a, int b);
  /// Throws TapeTooLong.
  int add(Node node);

  int parameter_count_;
  std::vector<Node> nodes_;
  std::map<double, int> constants_;
  std::map<std::tuple<TapeOp, int, int>, int> made_;
};

Scalar operator+(Scalar a, Scalar b);
Scalar operator-(Scalar a, Scalar b);
Scalar operator*(Scalar a, Scalar b);
Scalar operator/(Scalar a, Scalar b);
Scalar operator-(Scalar a);
Scalar operator+(Scalar a, double b);
Scalar operator-(Scalar a, double b);
Scalar operator*(Scalar a, double b);
Scalar operator/(Scalar a, double b);
Scalar operator+(double a, Scalar b);
Scalar operator-(double a, Scalar b);
Scalar operator*(double a, Scalar b);
Scalar min(Scalar a, Scalar b);
Scalar max(Scalar a, Scalar b);
Scalar max(Scalar a, double b);
Scalar min(Scalar a, double b);
Scalar abs(Scalar a);
Scalar sqrt(Scalar a);
Scalar sin(Scalar a);
Scalar cos(Scalar a);
Scalar exp(Scalar a);
Scalar floor(Scalar a);
Scalar atan2(Scalar a, Scalar b);
/// 1 or 0.
Scalar less(Scalar a, Scalar b);
Scalar clamp(Scalar a, Scalar low, Scalar high);
Scalar mix(Scalar a, Scalar b, Scalar weight);

}  // namespace swage
