// Fits templates to meshes.
#include <LBFGSB.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "measures.h"
#include "preparation.h"
#include "samples.h"
#include "stopwatch.h"
#include "surface.h"
#include "swage/error.h"
#include "swage/template_fit.h"

namespace swage {
namespace {

using Eigen::Index;
using Eigen::RowVector3d;
using Eigen::VectorXd;

constexpr double kOnePlace = 1e-9;  // Of the box: vertices nearer are one.
constexpr double kOffset = 0.15;    // How far the pose's offset may go, of D.
constexpr double kAtBound = 1e-4;   // Of a parameter's range.
constexpr int kEvaluations = 2;     // Of an iteration, on average.
constexpr double kUnsigned = 0.01;  // Less open area than this part is not told of.

void check_options(const FitOptions& options) {
  const auto refuse_unless = [](bool fits, const std::string& what) {
    if (!fits) throw InvalidInput("fit_template: options." + what);
  };
  refuse_unless(options.surface_samples >= 100 && options.surface_samples <= 10'000'000,
                "surface_samples: not between 100 and 10 million");
  refuse_unless(options.volume_samples >= 0 && options.volume_samples <= 10'000'000,
                "volume_samples: not between 0 and 10 million");
  refuse_unless(options.alpha >= 0 && std::isfinite(options.alpha), "alpha: not finite and at least 0");
  refuse_unless(options.sigmas >= 1 && options.sigmas <= 20, "sigmas: not between 1 and 20");
  refuse_unless(options.least_sigma > 0 && options.least_sigma <= 1, "least_sigma: not in (0, 1]");
  refuse_unless(options.iterations >= 1, "iterations: below 1");
  refuse_unless(options.up == 'x' || options.up == 'y' || options.up == 'z', "up: not x, y or z");
}

/// What the template is compared with, in the mesh's unit box.
struct Samples {
  Positions surface;
  VolumeSamples volume;
};

/// The objective, of the parameters as parts of their ranges and the pose's offset in units of `reach`.
class Objective {
 public:
  Objective(const Template& of, const Samples& samples, const TemplatePose& pose, double reach, double alpha,
            FieldStep& step, const Poll& poll)
      : template_(of),
        samples_(samples),
        pose_(pose),
        reach_(reach),
        alpha_(alpha),
        step_(step),
        poll_(poll),
        surface_(pose.into(samples.surface)),
        volume_(pose.into(samples.volume.points)),
        distances_(samples.volume.distances * pose.scale) {}

  Index size() const { return static_cast<Index>(template_.parameters().size()) + 3; }

  VectorXd start() const {
    VectorXd x = VectorXd::Constant(size(), 0.5);
    const auto& parameters = template_.parameters();
    for (size_t i = 0; i < parameters.size(); ++i) {
      x[static_cast<Index>(i)] =
          (parameters[i].value - parameters[i].least) / (parameters[i].most - parameters[i].least);
    }
    return x;
  }

  VectorXd parameters_at(const VectorXd& x) const {
    VectorXd values(size() - 3);
    for (Index i = 0; i < values.size(); ++i) {
      const TemplateParameter& p = template_.parameters()[static_cast<size_t>(i)];
      values[i] = std::clamp(p.least + x[i] * (p.most - p.least), p.least, p.most);
    }
    return values;
  }

  RowVector3d offset_at(const VectorXd& x) const {
    return reach_ * (2 * x.tail<3>().transpose() - RowVector3d::Ones());
  }

  void set_sigma(double sigma) { sigma_ = sigma; }

  /// As L-BFGS-B asks.
  double operator()(const VectorXd& x, VectorXd& gradient) {
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
    gradient.tail<3>() *= 2 * reach_;
    return energy;
  }

 private:
  /// The mean of weight error², both by `error(point, f)`.
  template <typename Error>
  double add(const Positions& points, const VectorXd& parameters, VectorXd& gradient, const Error& error) {
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

  const Template& template_;
  const Samples& samples_;
  TemplatePose pose_;
  double reach_, alpha_, sigma_ = 1;
  FieldStep& step_;
  const Poll& poll_;
  Positions surface_, volume_;
  VectorXd distances_;
  FieldValues field_;
};

/// Where L-BFGS-B got, and the energy there. The best of all it saw, since its line search may give up.
struct Minimum {
  VectorXd x;
  double energy = INFINITY;
  int iterations = 0;
};

Minimum minimise(Objective& objective, const VectorXd& start, int iterations) {
  LBFGSpp::LBFGSBParam<double> parameters;
  parameters.max_iterations = iterations;
  parameters.epsilon = 1e-9;
  parameters.epsilon_rel = 1e-9;
  parameters.past = 5;
  parameters.delta = 1e-7;
  Minimum best;
  int evaluations = 0;
  const auto evaluate = [&](const VectorXd& x, VectorXd& gradient) {
    if (++evaluations > kEvaluations * iterations) throw std::runtime_error("enough");
    const double energy = objective(x, gradient);
    if (std::isfinite(energy) && energy < best.energy) {
      best.x = x;
      best.energy = energy;
    }
    return energy;
  };
  VectorXd x = start;
  double energy = 0;
  try {
    LBFGSpp::LBFGSBSolver<double> solver(parameters);
    best.iterations = solver.minimize(evaluate, x, energy, VectorXd::Zero(x.size()), VectorXd::Ones(x.size()));
  } catch (const std::exception&) {
    // The line search found nothing better: what was found counts.
  }
  if (best.x.size() == 0) best.x = start;
  return best;
}

/// Turns that bring the mesh's up to the template's, and then by quarters about it.
Eigen::Matrix3d turn_of(char from, char to, int quarters) {
  const auto unit = [](char axis) -> Eigen::Vector3d { return Eigen::Vector3d::Unit(axis - 'x'); };
  const Eigen::Quaterniond up = Eigen::Quaterniond::FromTwoVectors(unit(from), unit(to));
  const Eigen::AngleAxisd about(quarters * std::numbers::pi / 2, unit(to));
  return about.toRotationMatrix() * up.toRotationMatrix();
}

/// Brings the box of the points to that of the template: their middles, and along up their bottoms.
TemplatePose aligned(const Positions& points, const Mesh& surface, char up, const Eigen::Matrix3d& rotation) {
  TemplatePose pose;
  pose.rotation = rotation;
  const Positions turned = points * rotation.transpose();
  const RowVector3d low = turned.colwise().minCoeff(), high = turned.colwise().maxCoeff();
  const RowVector3d to_low = surface.positions.colwise().minCoeff(), to_high = surface.positions.colwise().maxCoeff();
  pose.scale = (to_high - to_low).norm() / (high - low).norm();
  pose.offset = 0.5 * (to_low + to_high) - pose.scale * 0.5 * (low + high);
  const int u = up - 'x';
  pose.offset[u] = to_low[u] - pose.scale * low[u];
  return pose;
}

}  // namespace

Positions TemplatePose::into(const PositionsRef& positions) const {
  return (scale * (positions * rotation.transpose())).rowwise() + offset;
}

Positions TemplatePose::back(const PositionsRef& positions) const {
  return (positions.rowwise() - offset) * rotation / scale;
}

namespace {

/// Vertices of no triangle may lie anywhere.
Positions used(const PositionsRef& positions, const TrianglesRef& triangles) {
  Positions corners(3 * triangles.rows(), 3);
  for (Index i = 0; i < corners.rows(); ++i) corners.row(i) = positions.row(triangles(i / 3, i % 3));
  return corners;
}

class Fit {
 public:
  Fit(const Template& of, const Mesh& mesh, const FitOptions& options, Stages& stages)
      : template_(of),
        mesh_(mesh),
        options_(options),
        stages_(stages),
        step_(of.field(*(options.backend ? options.backend : cpu_backend()))) {}

  TemplateFit run() {
    stages_.begin("samples", 0);
    const SurfaceDistance distance(mesh_);
    samples_ = {surface_samples(mesh_, options_.surface_samples, options_.seed),
                volume_samples(mesh_, distance, options_.volume_samples, options_.seed + 1)};
    stages_.begin("starts", 0.1);
    Start best = best_start();
    for (int s = 1; s < options_.sigmas; ++s) {
      stages_.begin("fit", 0.4 + 0.6 * s / options_.sigmas);
      best.objective->set_sigma(sigma(s));
      const Minimum found = minimise(*best.objective, best.minimum.x, options_.iterations);
      result_.report.passes += found.iterations;
      best.minimum = found;
    }
    finish(best, distance.closed_area());
    return std::move(result_);
  }

 private:
  struct Start {
    TemplatePose pose;
    std::unique_ptr<Objective> objective;
    Minimum minimum;
  };

  double diagonal() const { return box_diagonal(mesh_.positions); }
  double sigma(int pass) const {
    const double part = options_.sigmas == 1 ? 1 : static_cast<double>(pass) / (options_.sigmas - 1);
    return scale_ * diagonal() * std::pow(options_.least_sigma, part);
  }

  /// After the first pass the best of the directions.
  Start best_start() {
    const Mesh surface = template_mesh(template_, template_.defaults(), {24, options_.backend});
    Start best;
    for (int quarters = 0; quarters < (options_.turns ? 4 : 1); ++quarters) {
      Start start;
      start.pose = aligned(mesh_.positions, surface, template_.up(), turn_of(options_.up, template_.up(), quarters));
      scale_ = start.pose.scale;
      start.objective = std::make_unique<Objective>(template_, samples_, start.pose, kOffset * scale_ * diagonal(),
                                                    options_.alpha, *step_, stages_.poll());
      for (int s = 0; s < options_.sigmas; s += options_.sigmas - 1) {
        start.objective->set_sigma(sigma(s));
        start.minimum = minimise(*start.objective, s == 0 ? start.objective->start() : start.minimum.x,
                                 options_.iterations / 2 + 1);
        result_.report.passes += start.minimum.iterations;
        if (options_.sigmas == 1) break;
      }
      if (start.minimum.energy < best.minimum.energy) best = std::move(start);
    }
    return best;
  }

  void finish(const Start& best, double closed_area) {
    result_.parameters = best.objective->parameters_at(best.minimum.x);
    result_.pose = best.pose;
    result_.pose.offset += best.objective->offset_at(best.minimum.x);
    FieldValues field;
    step_->evaluate(result_.pose.into(samples_.surface), result_.parameters, FieldDerivatives::in_space, field);
    const Eigen::ArrayXd off = field.values.array().abs() / field.gradients.rowwise().norm().array().max(1e-9);
    const double size = result_.pose.scale * diagonal();
    result_.residual = std::sqrt(off.square().mean()) / size;
    result_.largest = off.maxCoeff() / size;
    for (Index i = 0; i < result_.parameters.size(); ++i) {
      const double part = best.minimum.x[i];
      if (part < kAtBound || part > 1 - kAtBound) result_.at_bound.push_back(static_cast<int>(i));
    }
    result_.report.energy = best.minimum.energy;
    result_.report.stop = Termination::energy_settled;
    if (closed_area < 1 - kUnsigned) {
      result_.report.warnings.push_back(std::to_string(std::lround(100 * (1 - closed_area))) +
                                        " % of the surface is not closed and has no inside: distances from it have no "
                                        "sign");
    }
  }

  const Template& template_;
  const Mesh& mesh_;
  const FitOptions& options_;
  Stages& stages_;
  std::unique_ptr<FieldStep> step_;
  Samples samples_;
  double scale_ = 1;
  TemplateFit result_;
};

}  // namespace

TemplateFit fit_template(const Template& of, const PositionsRef& positions, const TrianglesRef& triangles,
                         const FitOptions& options, const ProgressFn& progress) {
  check(positions, triangles);
  check_options(options);
  const UnitBox box = unit_box(used(positions, triangles));
  const Surface surface = surface_of({box.into(positions), triangles}, kOnePlace);
  if (area_vectors(surface.mesh.positions, surface.mesh.triangles).isZero(0)) {
    throw InvalidInput("fit_template: triangles: none has an area");
  }
  TemplateFit fit;
  double seconds = 0;
  try {
    const Stopwatch watch(seconds);
    Stages stages(progress, 1, 1);
    fit = Fit(of, surface.mesh, options, stages).run();
  } catch (const Cancelled&) {
    fit.parameters = of.defaults();
    fit.report.stop = Termination::cancelled;
  }
  // From the unit box to mesh units.
  fit.pose.offset -= fit.pose.scale / box.extent * (box.corner * fit.pose.rotation.transpose());
  fit.pose.scale /= box.extent;
  fit.report.seconds["solve"] = seconds;
  return fit;
}

}  // namespace swage
