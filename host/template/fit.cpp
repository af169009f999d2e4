// Fits templates to meshes.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <utility>

#include "measures.h"
#include "messages.h"
#include "objective.h"
#include "pose.h"
#include "preparation.h"
#include "samples.h"
#include "stopwatch.h"
#include "surface.h"
#include "swage/error.h"
#include "swage/template_fit.h"

namespace swage {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kOnePlace = 1e-9;  // Of the box: vertices nearer are one.
constexpr double kAtBound = 1e-4;   // Of a parameter's range.
constexpr double kUnsigned = 0.01;  // Less open area than this part is not told of.
constexpr double kTurn = 1e-6;
constexpr double kFlat = 0.2;   // Of the mean steepness: the least that counts.
constexpr double kFew = 0.125;  // Of the samples, for attempts,
constexpr int kLeastFew = 400;  // or so many.
constexpr int kFirstIterations = 40;
constexpr size_t kGuesses = 24;  // With the start itself.
constexpr size_t kGuessed = 6;   // Of them, in all directions, are followed.
constexpr size_t kFinalists = 2;
constexpr int kBoxResolution = 32;
constexpr int kSurfaceResolution = 48, kSurfaceSamples = 1000;

void check_options(const Template& of, const FitOptions& options) {
  const auto refuse_unless = [](bool fits, const std::string& what) {
    if (!fits) throw InvalidInput("fit_template: options." + what);
  };
  const auto refuse_outside = [&](const char* option, double value, bool fits, const char* range) {
    refuse_unless(fits, std::string(option) + ": " + digits(value) + " is not " + range);
  };
  refuse_outside("surface_samples", options.surface_samples,
                 options.surface_samples >= 100 && options.surface_samples <= 10'000'000, "between 100 and 10 million");
  refuse_outside("volume_samples", options.volume_samples,
                 options.volume_samples >= 0 && options.volume_samples <= 10'000'000, "between 0 and 10 million");
  refuse_outside("alpha", options.alpha, options.alpha >= 0 && std::isfinite(options.alpha), "finite and at least 0");
  refuse_outside("sigmas", options.sigmas, options.sigmas >= 1 && options.sigmas <= 20, "between 1 and 20");
  refuse_outside("least_sigma", options.least_sigma, options.least_sigma > 0 && options.least_sigma <= 1, "in (0, 1]");
  refuse_outside("iterations", options.iterations, options.iterations >= 1, "at least 1");
  refuse_unless(options.up == 0 || (options.up >= 'x' && options.up <= 'z'),
                "up: '" + std::string(1, options.up) + "' is not x, y, z or 0");
  if (options.start.size() > 0) {
    const size_t count = of.parameters().size();
    refuse_unless(
        static_cast<size_t>(options.start.size()) == count && options.start.allFinite(),
        "start: not " + std::to_string(count) + " finite numbers; give a value for each of the template's parameters");
  }
  if (options.pose) {
    const TemplatePose& pose = *options.pose;
    const bool turns = (pose.rotation * pose.rotation.transpose()).isIdentity(kTurn) && pose.rotation.determinant() > 0;
    refuse_unless(turns, "pose: its rotation is none; give one that neither mirrors nor scales");
    refuse_unless(pose.scale > 0 && std::isfinite(pose.scale) && pose.offset.allFinite(),
                  "pose: scale " + digits(pose.scale) + " is not above 0, or something is not finite; mend it");
  }
}

/// Vertices of no triangle may lie anywhere.
Positions used(const PositionsRef& positions, const TrianglesRef& triangles) {
  Positions corners(3 * triangles.rows(), 3);
  for (Index i = 0; i < corners.rows(); ++i) corners.row(i) = positions.row(triangles(i / 3, i % 3));
  return corners;
}

TemplatePose in_unit_box(TemplatePose pose, const UnitBox& box) {
  pose.offset += pose.scale * (box.corner * pose.rotation.transpose());
  pose.scale *= box.extent;
  return pose;
}

TemplatePose in_mesh_units(TemplatePose pose, const UnitBox& box) {
  pose.scale /= box.extent;
  pose.offset -= pose.scale * (box.corner * pose.rotation.transpose());
  return pose;
}

class Fit {
 public:
  Fit(const Template& of, const Mesh& mesh, const FitOptions& options, Stages& stages)
      : template_(of),
        mesh_(mesh),
        options_(options),
        stages_(stages),
        step_(of.field(*(options.backend ? options.backend : cpu_backend()))),
        diagonal_(box_diagonal(mesh.positions)),
        distance_(mesh) {}

  TemplateFit run() {
    stages_.begin("samples", 0);
    few_ = samples(kFew);
    all_ = samples(1);
    std::vector<Attempt> attempts = first_attempts();
    for (size_t i = 0; i < attempts.size(); ++i) {
      stages_.begin("starts", 0.1 + 0.4 * static_cast<double>(i) / static_cast<double>(attempts.size()));
      minimise_by(attempts[i], 0, kFirstIterations);
      minimise_by(attempts[i], options_.sigmas - 1, kFirstIterations);
    }
    rank(attempts);
    keep_best(attempts, kFinalists);
    for (size_t i = 0; i < attempts.size(); ++i) {
      stages_.begin("fit", 0.5 + 0.5 * static_cast<double>(i) / static_cast<double>(attempts.size()));
      use(attempts[i], all_);
      for (int s = 0; s < options_.sigmas; ++s) minimise_by(attempts[i], s, options_.iterations);
    }
    rank(attempts);
    keep_best(attempts, 1);
    finish(attempts[0]);
    return std::move(result_);
  }

 private:
  /// A place in the parameters' ranges from which a minimum is looked for.
  struct Attempt {
    TemplatePose pose;
    std::unique_ptr<Objective> objective;
    Minimum minimum;
  };

  FitSamples samples(double part) const {
    const auto of = [&](int count, int least) {
      return std::min(count, std::max(least, static_cast<int>(std::lround(part * count))));
    };
    return {surface_samples(mesh_, of(options_.surface_samples, kLeastFew), options_.seed),
            volume_samples(mesh_, distance_, of(options_.volume_samples, kLeastFew), options_.seed + 1)};
  }

  double sigma(int pass) const {
    const double part = options_.sigmas == 1 ? 1 : static_cast<double>(pass) / (options_.sigmas - 1);
    return std::pow(options_.least_sigma, part);
  }

  void minimise_by(Attempt& attempt, int pass, int iterations) {
    attempt.objective->set_sigma(sigma(pass));
    attempt.minimum = minimise(*attempt.objective, attempt.minimum.x, iterations);
    result_.report.passes += attempt.minimum.iterations;
  }

  void use(Attempt& attempt, const FitSamples& samples) {
    attempt.objective = std::make_unique<Objective>(template_, samples, attempt.pose, diagonal_, options_.alpha, *step_,
                                                    stages_.poll());
    if (options_.pose) attempt.objective->hold_offset();
  }

  /// From the template's surface to the mesh, root mean square, a part of D.
  double excess_of(const Attempt& attempt) const {
    const VectorXd parameters = attempt.objective->parameters_at(attempt.minimum.x);
    Mesh surface;
    try {
      surface = template_mesh(template_, parameters, {kSurfaceResolution, options_.backend});
    } catch (const Unsolvable&) {
      return INFINITY;
    }
    const Positions points =
        attempt.objective->pose_at(attempt.minimum.x).back(surface_samples(surface, kSurfaceSamples, options_.seed));
    double sum = 0;
    for (const auto& point : points.rowwise()) sum += std::pow(distance_(point).distance, 2);
    return std::sqrt(sum / static_cast<double>(points.rows())) / diagonal_;
  }

  /// By the whole space about the mesh, and by what the template has beyond it, which no sample sees.
  void rank(std::vector<Attempt>& attempts) const {
    VectorXd gradient;
    for (Attempt& attempt : attempts) {
      ask(stages_.poll());
      attempt.objective->set_sigma(1);
      attempt.minimum.energy = (*attempt.objective)(attempt.minimum.x, gradient);
      attempt.minimum.energy += std::pow(100 * excess_of(attempt), 2);  // The energy is in percents too.
    }
  }

  static void keep_best(std::vector<Attempt>& attempts, size_t count) {
    std::stable_sort(attempts.begin(), attempts.end(),
                     [](const Attempt& a, const Attempt& b) { return a.minimum.energy < b.minimum.energy; });
    if (attempts.size() > count) attempts.resize(count);
  }

  std::vector<Eigen::Matrix3d> turns() const {
    std::vector<Eigen::Matrix3d> all;
    for (const char up : options_.up == 0 ? std::string("yz") : std::string(1, options_.up)) {
      for (int quarters = 0; quarters < (options_.turns ? 4 : 1); ++quarters) {
        all.push_back(turn_of(up, template_.up(), quarters));
      }
    }
    return all;
  }

  Attempt attempt(const VectorXd& parameters, const TemplatePose& pose) {
    Attempt made;
    made.pose = pose;
    use(made, few_);
    made.minimum.x = made.objective->place_of(parameters);
    made.objective->set_sigma(1);
    VectorXd gradient;
    made.minimum.energy = (*made.objective)(made.minimum.x, gradient);
    return made;
  }

  /// What to start with, and guesses about it.
  std::vector<VectorXd> guesses() const {
    std::vector<VectorXd> all{options_.start.size() > 0 ? options_.start : template_.defaults()};
    std::mt19937 random(options_.seed);
    const auto part = [&] { return static_cast<double>(random()) / 4294967296.0; };
    const size_t count = options_.start.size() > 0 ? 1 : kGuesses;
    while (all.size() < count) {
      VectorXd guess = all.front();
      for (Index i = 0; i < guess.size(); ++i) {
        const TemplateParameter& p = template_.parameters()[static_cast<size_t>(i)];
        const double is_other = part(), by = part();
        if (is_other < 0.5) guess[i] = std::clamp(guess[i] + (by - 0.5) * (p.most - p.least), p.least, p.most);
      }
      all.push_back(std::move(guess));
    }
    return all;
  }

  /// From the start in all directions, and from those guesses that are most like the mesh.
  std::vector<Attempt> first_attempts() {
    if (options_.pose) {
      std::vector<Attempt> one;
      one.push_back(attempt(guesses().front(), *options_.pose));
      return one;
    }
    std::vector<Attempt> all, guessed;
    for (const VectorXd& parameters : guesses()) {
      const std::optional<Box> box = box_of(FieldAt{*step_, parameters}, kBoxResolution, stages_.poll());
      if (!box) continue;
      std::vector<Attempt>& list = all.empty() ? all : guessed;
      for (const Eigen::Matrix3d& turn : turns()) {
        list.push_back(attempt(parameters, aligned(mesh_.positions, *box, template_.up(), turn)));
      }
    }
    if (all.empty())
      throw Unsolvable("template " + template_.name() +
                       ": there is no surface to begin with; give other parameters as options.start");
    keep_best(guessed, kGuessed);
    std::move(guessed.begin(), guessed.end(), std::back_inserter(all));
    return all;
  }

  void finish(const Attempt& best) {
    const double closed_area = distance_.closed_area();
    result_.excess = excess_of(best);
    result_.parameters = best.objective->parameters_at(best.minimum.x);
    result_.pose = best.objective->pose_at(best.minimum.x);
    FieldValues field;
    step_->evaluate(result_.pose.into(all_.surface), result_.parameters, FieldDerivatives::in_space, field);
    const Eigen::ArrayXd steepness = field.gradients.rowwise().norm();
    // Where slopes of two sides cancel, a step along the slope goes nowhere.
    const Eigen::ArrayXd off = field.values.array().abs() / steepness.max(kFlat * std::max(steepness.mean(), 1e-9));
    const double size = result_.pose.scale * diagonal_;
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
  double diagonal_;
  SurfaceDistance distance_;
  FitSamples few_, all_;
  TemplateFit result_;
};

}  // namespace

TemplateFit fit_template(const Template& of, const PositionsRef& positions, const TrianglesRef& triangles,
                         const FitOptions& options, const ProgressFn& progress) {
  check(positions, triangles);
  check_options(of, options);
  const UnitBox box = unit_box(used(positions, triangles));
  const Surface surface = surface_of({box.into(positions), triangles}, kOnePlace);
  if (area_vectors(surface.mesh.positions, surface.mesh.triangles).isZero(0)) {
    throw InvalidInput("fit_template: triangles: none has an area; check the mesh's units and coordinates");
  }
  FitOptions inner = options;
  if (inner.pose) *inner.pose = in_unit_box(*inner.pose, box);
  TemplateFit fit;
  double seconds = 0;
  try {
    const Stopwatch watch(seconds);
    Stages stages(progress, 1, 1);
    fit = Fit(of, surface.mesh, inner, stages).run();
  } catch (const Cancelled&) {
    fit.parameters = of.defaults();
    fit.report.stop = Termination::cancelled;
  }
  fit.pose = in_mesh_units(fit.pose, box);
  fit.report.seconds["solve"] = seconds;
  fit.report.paths["field"] = options.backend ? options.backend->name() : cpu_backend()->name();
  return fit;
}

}  // namespace swage
