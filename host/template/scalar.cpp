#include "scalar.h"

#include <algorithm>
#include <cmath>

namespace swage {
namespace {

constexpr std::size_t kMostValues = 50'000;

/// Not so minima and maxima: of equals the first tells the slope, so that a corner that lies on a box has one.
bool commutes(TapeOp op) { return op == TapeOp::add || op == TapeOp::multiply; }

}  // namespace

TapeBuilder::TapeBuilder(const std::vector<double>& defaults) : parameter_count_(static_cast<int>(defaults.size())) {
  for (const double value : defaults) add({Node::Kind::parameter, value, {}, false});
  for (int axis = 0; axis < 3; ++axis) add({Node::Kind::coordinate, 0, {}, true});
}

int TapeBuilder::add(Node node) {
  if (nodes_.size() == kMostValues) throw TapeTooLong();
  nodes_.push_back(node);
  return static_cast<int>(nodes_.size()) - 1;
}

Scalar TapeBuilder::constant(double value) {
  if (value == 0) value = 0;  // No -0.
  const auto [found, is_new] = constants_.try_emplace(value, 0);
  if (is_new) found->second = add({Node::Kind::constant, value, {}, false});
  return {this, found->second};
}

/// An argument or constant that the operation gives whatever the rest is; -1 where there is none.
int TapeBuilder::simplified(TapeOp op, int a, int b) {
  const auto is = [&](int id, double value) { return is_constant(id) && node(id).value == value; };
  switch (op) {
    case TapeOp::add:
      return is(a, 0) ? b : is(b, 0) ? a : -1;
    case TapeOp::subtract:
      return is(b, 0) ? a : a == b ? constant(0).id : -1;
    case TapeOp::multiply:
      return is(a, 0) || is(b, 1) ? a : is(b, 0) || is(a, 1) ? b : -1;
    case TapeOp::divide:
      return is(b, 1) ? a : -1;
    case TapeOp::minimum:
    case TapeOp::maximum:
      return a == b ? a : -1;
    default:
      return -1;
  }
}

Scalar TapeBuilder::apply(TapeOp op, Scalar first, Scalar second) {
  int a = first.id, b = is_binary(op) ? second.id : first.id;
  if (is_constant(a) && is_constant(b)) return constant(value_of(op, node(a).value, node(b).value));
  if (const int simple = simplified(op, a, b); simple >= 0) return {this, simple};
  if (commutes(op) && a > b) std::swap(a, b);
  const auto [found, is_new] = made_.try_emplace({op, a, b}, 0);
  if (is_new) {
    const double value = value_of(op, node(a).value, node(b).value);
    found->second = add({Node::Kind::made, value, {op, a, b}, node(a).of_point || node(b).of_point});
  }
  return {this, found->second};
}

Tape TapeBuilder::tape(Scalar root) const {
  std::vector<char> needed(nodes_.size(), 0);
  needed[static_cast<size_t>(root.id)] = 1;
  for (int id = root.id; id >= 0; --id) {
    if (needed[static_cast<size_t>(id)] == 0 || node(id).kind != Node::Kind::made) continue;
    needed[static_cast<size_t>(node(id).instruction.a)] = 1;
    needed[static_cast<size_t>(node(id).instruction.b)] = 1;
  }
  Tape tape;
  tape.parameter_count = parameter_count_;
  std::vector<int> slots(nodes_.size(), -1);
  int next = 0;
  const auto place = [&](Node::Kind kind, bool of_point, auto&& put) {
    for (size_t id = 0; id < nodes_.size(); ++id) {
      const Node& own = nodes_[id];
      const bool always = kind == Node::Kind::parameter || kind == Node::Kind::coordinate;
      if (own.kind != kind || own.of_point != of_point || (needed[id] == 0 && !always)) continue;
      put(own);
      slots[id] = next++;
    }
  };
  const auto instruction = [&](const Node& own) -> TapeInstruction {
    return {own.instruction.op, slots[static_cast<size_t>(own.instruction.a)],
            slots[static_cast<size_t>(own.instruction.b)]};
  };
  place(Node::Kind::parameter, false, [](const Node&) {});
  place(Node::Kind::constant, false, [&](const Node& own) { tape.constants.push_back(own.value); });
  place(Node::Kind::made, false, [&](const Node& own) { tape.setup.push_back(instruction(own)); });
  place(Node::Kind::coordinate, true, [](const Node&) {});
  place(Node::Kind::made, true, [&](const Node& own) { tape.body.push_back(instruction(own)); });
  tape.root = slots[static_cast<size_t>(root.id)];
  return tape;
}

Scalar operator+(Scalar a, Scalar b) { return a.builder->apply(TapeOp::add, a, b); }
Scalar operator-(Scalar a, Scalar b) { return a.builder->apply(TapeOp::subtract, a, b); }
Scalar operator*(Scalar a, Scalar b) { return a.builder->apply(TapeOp::multiply, a, b); }
Scalar operator/(Scalar a, Scalar b) { return a.builder->apply(TapeOp::divide, a, b); }
Scalar operator-(Scalar a) { return a.builder->apply(TapeOp::negate, a, a); }
Scalar operator+(Scalar a, double b) { return a + a.builder->constant(b); }
Scalar operator-(Scalar a, double b) { return a - a.builder->constant(b); }
Scalar operator*(Scalar a, double b) { return a * a.builder->constant(b); }
Scalar operator/(Scalar a, double b) { return a / a.builder->constant(b); }
Scalar operator+(double a, Scalar b) { return b.builder->constant(a) + b; }
Scalar operator-(double a, Scalar b) { return b.builder->constant(a) - b; }
Scalar operator*(double a, Scalar b) { return b.builder->constant(a) * b; }
Scalar min(Scalar a, Scalar b) { return a.builder->apply(TapeOp::minimum, a, b); }
Scalar max(Scalar a, Scalar b) { return a.builder->apply(TapeOp::maximum, a, b); }
Scalar max(Scalar a, double b) { return max(a, a.builder->constant(b)); }
Scalar min(Scalar a, double b) { return min(a, a.builder->constant(b)); }
Scalar abs(Scalar a) { return a.builder->apply(TapeOp::absolute, a, a); }
Scalar sqrt(Scalar a) { return a.builder->apply(TapeOp::root, a, a); }
Scalar sin(Scalar a) { return a.builder->apply(TapeOp::sine, a, a); }
Scalar cos(Scalar a) { return a.builder->apply(TapeOp::cosine, a, a); }
Scalar exp(Scalar a) { return a.builder->apply(TapeOp::exponential, a, a); }
Scalar floor(Scalar a) { return a.builder->apply(TapeOp::floor, a, a); }
Scalar atan2(Scalar a, Scalar b) { return a.builder->apply(TapeOp::arctangent, a, b); }
Scalar less(Scalar a, Scalar b) { return a.builder->apply(TapeOp::less, a, b); }
Scalar clamp(Scalar a, Scalar low, Scalar high) { return min(max(a, low), high); }
Scalar mix(Scalar a, Scalar b, Scalar weight) { return a + weight * (b - a); }

}  // namespace swage
