#include "objective.h"

#include <LBFGSB.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace swage {
namespace {

using Eigen::Index;
using Eigen::RowVector3d;
using Eigen::VectorXd;

constexpr double kOffset = 0.15;   // How far the pose's offset may go, of D, to either side.
constexpr double kSettled = 1e-6;  // What the energy falls by in a few iterations.
constexpr int kPast = 5;           // Those.
constexpr int kEvaluations = 2;    // Of an iteration, by and large: beyond it ends.
constexpr int kRestarts = 3;
constexpr double kWorthwhile = 1e-3;  // What a restart must lower the energy by to be followed by another.

/// Beyond the evaluations that it has.
struct Exhausted : std::runtime_error {
  Exhausted() : std::runtime_error("") {}
};

}  // namespace

Objective::Objective(const Template& of, const FitSamples& samples, const TemplatePose& pose, double diagonal,
                     double alpha, FieldStep& step, const Poll& poll)
    : template_(of),
      samples_(samples),
      pose_(pose),
      size_(pose.scale * diagonal),
      alpha_(alpha),
      sigma_(size_),
      step_(step),
      poll_(poll),
      surface_(pose.into(samples.surface)),
      volume_(pose.into(samples.volume.points)),
      distances_(samples.volume.distances * pose.scale) {}

VectorXd Objective::place_of(const VectorXd& parameters) const {
  VectorXd x = VectorXd::Constant(size(), 0.5);
  for (Index i = 0; i < parameters.size(); ++i) {
    const TemplateParameter& p = template_.parameters()[static_cast<size_t>(i)];
    x[i] = std::clamp((parameters[i] - p.least) / (p.most - p.least), 0.0, 1.0);
  }
  return x;
}

VectorXd Objective::parameters_at(const VectorXd& x) const {
  VectorXd values(size() - 3);
  for (Index i = 0; i < values.size(); ++i) {
    const TemplateParameter& p = template_.parameters()[static_cast<size_t>(i)];
    values[i] = std::clamp(p.least + x[i] * (p.most - p.least), p.least, p.most);
  }
  return values;
}

RowVector3d Objective::offset_at(const VectorXd& x) const {
  return kOffset * size_ * (2 * x.tail<3>().transpose() - RowVector3d::Ones());
}

TemplatePose Objective::pose_at(const VectorXd& x) const {
  TemplatePose pose = pose_;
  pose.offset += offset_at(x);
  return pose;
}

double Objective::operator()(const VectorXd& x, VectorXd& gradient) {
  ask(poll_);
  gradient.setZero(size());
  const VectorXd parameters = parameters_at(x);
  const RowVector3d offset = offset_at(x);
  double energy =
      add(surface_.rowwise() + offset, parameters, gradient, [](Index, double f) { return std::pair(f, 1.0); });
  if (volume_.rows() > 0 && alpha_ > 0) {
    energy += add(volume_.rowwise() + offset, parameters, gradient, [&](Index p, double f) {
      const double d = distances_[p], weight = alpha_ * std::exp(-d * d / (sigma_ * sigma_));
      const bool is_signed = samples_.volume.is_signed[static_cast<size_t>(p)] != 0;
      return std::pair(is_signed || f >= 0 ? f - d : f + d, weight);
    });
  }
  for (Index i = 0; i + 3 < size(); ++i) {
    const TemplateParameter& p = template_.parameters()[static_cast<size_t>(i)];
    gradient[i] *= p.most - p.least;
  }
  gradient.tail<3>() *= offset_is_held_ ? 0 : 2 * kOffset * size_;
  const double percents = 1e4 / (size_ * size_);
  gradient *= percents;
  return energy * percents;
}

/// The mean of weight error², both by `error(point, f)`, and its derivatives.
template <typename Error>
double Objective::add(const Positions& points, const VectorXd& parameters, VectorXd& gradient, const Error& error) {
  step_.evaluate(points, parameters, FieldDerivatives::all, field_);
  double energy = 0;
  VectorXd slopes(points.rows());
  for (Index p = 0; p < points.rows(); ++p) {
    const auto [off, weight] = error(p, field_.values[p]);
    energy += weight * off * off;
    slopes[p] = 2 * weight * off;
  }
  const double count = static_cast<double>(points.rows());
  gradient.head(size() - 3) += field_.by_parameters.transpose() * slopes / count;
  gradient.tail<3>() += field_.gradients.transpose() * slopes / count;
  return energy / count;
}

/// Fields have kinks, at which line searches give up: a restart without memory of slopes goes on from the best place.
Minimum minimise(Objective& objective, const VectorXd& start, int iterations) {
  LBFGSpp::LBFGSBParam<double> parameters;
  parameters.epsilon = parameters.epsilon_rel = kSettled;
  parameters.past = kPast;
  parameters.delta = kSettled;
  Minimum best;
  best.x = start;
  int evaluations = 0;
  const auto evaluate = [&](const VectorXd& x, VectorXd& gradient) {
    if (evaluations++ == kEvaluations * iterations) throw Exhausted();
    const double energy = objective(x, gradient);
    if (std::isfinite(energy) && energy < best.energy) {
      best.x = x;
      best.energy = energy;
    }
    return energy;
  };
  for (int run = 0; run <= kRestarts && best.iterations < iterations; ++run) {
    const double before = best.energy;
    parameters.max_iterations = iterations - best.iterations;
    VectorXd x = best.x;
    double energy = 0;
    try {
      LBFGSpp::LBFGSBSolver<double> solver(parameters);
      best.iterations += solver.minimize(evaluate, x, energy, VectorXd::Zero(x.size()), VectorXd::Ones(x.size()));
    } catch (const Exhausted&) {
      break;
    } catch (const std::exception&) {
      // Its line search found nothing better: what was found counts.
    }
    if (!(best.energy < (1 - kWorthwhile) * before)) break;
  }
  best.iterations = std::max(best.iterations, evaluations / kEvaluations);
  return best;
}

}  // namespace swage
