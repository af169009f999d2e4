// A tape's values and, by the chain rule backwards through it, its derivatives.
#include <algorithm>

#include "cpu_steps.h"
#include "swage/thrown.h"

namespace swage {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

class CpuField final : public FieldStep {
 public:
  explicit CpuField(const Tape& tape) : tape_(tape) {}

  void evaluate(const Positions& points, const VectorXd& parameters, FieldDerivatives derivatives,
                FieldValues& field) override {
    check_rows("FieldStep::evaluate", "parameters", parameters.size(), tape_.parameter_count);
    const Index count = points.rows();
    const bool in_space = derivatives != FieldDerivatives::none, all = derivatives == FieldDerivatives::all;
    field.values.resize(count);
    if (in_space) field.gradients.resize(count, 3);
    if (all) field.by_parameters.resize(count, tape_.parameter_count);
    const int uniforms = tape_.uniform_count();
    const VectorXd fixed = uniforms_of(parameters);
    constexpr Index kBlock = 128;
    Thrown thrown;
#pragma omp parallel for schedule(static)
    for (Index first = 0; first < count; first += kBlock) {
      thrown.keep([&] {
        VectorXd values(tape_.slot_count()), slopes(tape_.slot_count());
        values.head(uniforms) = fixed;
        for (Index p = first; p < std::min(first + kBlock, count); ++p) {
          values.segment<3>(uniforms) = points.row(p);
          run(tape_.body, uniforms + 3, values);
          field.values[p] = values[tape_.root];
          if (!in_space) continue;
          slopes.setZero();
          slopes[tape_.root] = 1;
          run_back(tape_.body, tape_.slot_count(), values, slopes);
          field.gradients.row(p) = slopes.segment<3>(uniforms);
          if (!all) continue;
          run_back(tape_.setup, uniforms, values, slopes);
          field.by_parameters.row(p) = slopes.head(tape_.parameter_count);
        }
      });
    }
    thrown.rethrow();
  }

 private:
  static void run(const std::vector<TapeInstruction>& instructions, int slot, VectorXd& values) {
    for (const auto& [op, a, b] : instructions) values[slot++] = value_of(op, values[a], values[b]);
  }

  /// Of instructions whose last slot is before `slot`.
  static void run_back(const std::vector<TapeInstruction>& instructions, int slot, const VectorXd& values,
                       VectorXd& slopes) {
    for (size_t i = instructions.size(); i-- > 0;) {
      const auto& [op, a, b] = instructions[i];
      const double slope = slopes[--slot];
      if (slope == 0) continue;
      const TapeSlopes own = slopes_of(op, values[a], values[b], values[slot]);
      slopes[a] += slope * own.a;
      if (is_binary(op)) slopes[b] += slope * own.b;
    }
  }

  VectorXd uniforms_of(const VectorXd& parameters) const {
    VectorXd values(tape_.uniform_count());
    values.head(tape_.parameter_count) = parameters;
    std::copy(tape_.constants.begin(), tape_.constants.end(), values.data() + tape_.parameter_count);
    run(tape_.setup, tape_.parameter_count + static_cast<int>(tape_.constants.size()), values);
    return values;
  }

  Tape tape_;
};

}  // namespace

std::unique_ptr<FieldStep> cpu_field(const Tape& tape) { return std::make_unique<CpuField>(tape); }

}  // namespace swage
