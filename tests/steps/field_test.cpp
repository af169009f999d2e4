// The field step: values as a tape's instructions make them, derivatives as differences do, by every backend.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "opencl_device.h"
#include "swage/backend.h"
#include "swage/template.h"

namespace swage {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

struct Who {
  const char* name;
  std::shared_ptr<Backend> (*backend)();
  double tolerance;
};

const Who kWho[] = {
    {"cpu", [] { return cpu_backend(); }, 1e-12},
    {"opencl_single", [] { return test::opencl_or_skip(Precision::single); }, 2e-5},
    {"opencl_double", [] { return test::opencl_or_skip(Precision::twice); }, 1e-12},
};

/// Run in long double, apart from the steps' code.
long double value_at(const Tape& tape, const VectorXd& parameters, const Eigen::RowVector3d& point) {
  std::vector<long double> slots(parameters.data(), parameters.data() + parameters.size());
  slots.insert(slots.end(), tape.constants.begin(), tape.constants.end());
  const auto run = [&](const std::vector<TapeInstruction>& instructions) {
    for (const auto& [op, first, second] : instructions) {
      const long double a = slots[static_cast<size_t>(first)], b = slots[static_cast<size_t>(second)];
      const auto made = [&, op = op]() -> long double {
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
            return std::fmin(a, b);
          case TapeOp::maximum:
            return std::fmax(a, b);
          case TapeOp::arctangent:
            return std::atan2(a, b);
          case TapeOp::less:
            return a < b ? 1 : 0;
          case TapeOp::negate:
            return -a;
          case TapeOp::absolute:
            return std::fabs(a);
          case TapeOp::root:
            return a > 0 ? std::sqrt(a) : 0;
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
      };
      slots.push_back(made());
    }
  };
  run(tape.setup);
  for (int axis = 0; axis < 3; ++axis) slots.push_back(point[axis]);
  run(tape.body);
  return slots[static_cast<size_t>(tape.root)];
}

/// Of a function of one number. Whether it is smooth there is told by how much the two sides differ.
struct Slope {
  double value;
  bool is_smooth;
};

template <typename Function>
Slope slope_at(double x, double step, const Function& f) {
  const long double before = f(x - step), here = f(x), after = f(x + step);
  const auto left = static_cast<double>((here - before) / step), right = static_cast<double>((after - here) / step);
  const double value = 0.5 * (left + right);
  return {value, std::abs(left - right) < 1e-4 * (1 + std::abs(value))};
}

Positions random_points(int count, double reach, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(-reach, reach);
  Positions points(count, 3);
  for (Index i = 0; i < points.size(); ++i) points.data()[i] = part(random);
  return points;
}

VectorXd random_parameters(const Template& of, unsigned seed) {
  std::mt19937 random(seed);
  VectorXd values = of.defaults();
  for (Index i = 0; i < values.size(); ++i) {
    const TemplateParameter& p = of.parameters()[static_cast<size_t>(i)];
    values[i] = std::uniform_real_distribution<double>(p.least, p.most)(random);
  }
  return values;
}

class FieldStepBy : public testing::TestWithParam<Who> {
 protected:
  void SetUp() override { backend_ = GetParam().backend(); }

  FieldValues evaluated(const Template& of, const VectorXd& parameters, const Positions& points) const {
    FieldValues field;
    backend_->field(of.tape())->evaluate(points, parameters, FieldDerivatives::all, field);
    return field;
  }

  std::shared_ptr<Backend> backend_;
};

TEST_P(FieldStepBy, RunsTheTape) {
  if (!backend_) return;
  for (const std::string& name : shipped_templates()) {
    const Template of = shipped_template(name);
    for (unsigned seed = 0; seed < 3; ++seed) {
      const VectorXd parameters = seed == 0 ? of.defaults() : random_parameters(of, seed);
      const Positions points = random_points(133, 3, seed);
      const FieldValues field = evaluated(of, parameters, points);
      ASSERT_EQ(field.values.size(), points.rows());
      for (Index p = 0; p < points.rows(); ++p) {
        const auto expected = static_cast<double>(value_at(of.tape(), parameters, points.row(p)));
        EXPECT_NEAR(field.values[p], expected, GetParam().tolerance * (10 + std::abs(expected))) << name << " " << p;
      }
    }
  }
}

TEST_P(FieldStepBy, HasTheSlopesOfItsValues) {
  if (!backend_) return;
  const double tolerance = std::max(1e-6, 100 * GetParam().tolerance);
  int smooth = 0, all = 0;
  for (const std::string& name : shipped_templates()) {
    const Template of = shipped_template(name);
    const VectorXd parameters = random_parameters(of, 7);
    const Positions points = random_points(40, 2, 8);
    const FieldValues field = evaluated(of, parameters, points);
    for (Index p = 0; p < points.rows(); ++p) {
      const Eigen::RowVector3d point = points.row(p);
      for (int axis = 0; axis < 3; ++axis) {
        const Slope slope = slope_at(point[axis], 1e-6, [&](double x) {
          Eigen::RowVector3d moved = point;
          moved[axis] = x;
          return value_at(of.tape(), parameters, moved);
        });
        ++all;
        if (!slope.is_smooth) continue;
        ++smooth;
        EXPECT_NEAR(field.gradients(p, axis), slope.value, tolerance * (1 + std::abs(slope.value))) << name << " " << p;
      }
      for (Index m = 0; m < parameters.size(); ++m) {
        const Slope slope = slope_at(parameters[m], 1e-6, [&](double x) {
          VectorXd moved = parameters;
          moved[m] = x;
          return value_at(of.tape(), moved, point);
        });
        ++all;
        if (!slope.is_smooth) continue;
        ++smooth;
        EXPECT_NEAR(field.by_parameters(p, m), slope.value, tolerance * (1 + std::abs(slope.value)))
            << name << " " << p << " " << of.parameters()[static_cast<size_t>(m)].name;
      }
    }
  }
  EXPECT_GT(smooth, 0.98 * all);
}

TEST_P(FieldStepBy, LeavesWhatIsNotAskedFor) {
  if (!backend_) return;
  const Template of = shipped_template("mug");
  FieldValues field;
  const auto step = backend_->field(of.tape());
  step->evaluate(random_points(5, 1, 1), of.defaults(), FieldDerivatives::none, field);
  EXPECT_EQ(field.values.size(), 5);
  EXPECT_EQ(field.gradients.size(), 0);
  step->evaluate(random_points(70, 1, 1), of.defaults(), FieldDerivatives::in_space, field);
  EXPECT_EQ(field.gradients.rows(), 70);
  EXPECT_EQ(field.by_parameters.size(), 0);
  step->evaluate(random_points(37, 1, 1), of.defaults(), FieldDerivatives::all, field);
  EXPECT_EQ(field.by_parameters.rows(), 37);
  step->evaluate(Positions(0, 3), of.defaults(), FieldDerivatives::all, field);
  EXPECT_EQ(field.values.size(), 0);
  EXPECT_THROW(step->evaluate(Positions(1, 3), VectorXd::Zero(2), FieldDerivatives::none, field), InvalidInput);
}

INSTANTIATE_TEST_SUITE_P(Backends, FieldStepBy, testing::ValuesIn(kWho),
                         [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace swage
