#include "template_fitting.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <limits>

namespace swage::cli {
namespace {

constexpr double kPoor = 0.06;  // Of the diagonal: a shape that is not the template's.

}  // namespace

CLI::Option* add_up_option(CLI::App& app, const char* name, const std::function<void(char)>& set,
                           const std::string& help) {
  return app
      .add_option_function<std::string>(
          name, [set](const std::string& axis) { set(axis == "auto" ? '\0' : axis[0]); }, help)
      ->group("Fit")
      ->check(CLI::IsMember({"auto", "x", "y", "z"}))
      ->type_name("AXIS");
}

std::vector<CLI::Option*> add_fitting_options(CLI::App& app, FitOptions& options) {
  std::vector<CLI::Option*> all;
  const auto add = [&](const char* name, auto& value, const std::string& help, double low, double high) {
    all.push_back(
        app.add_option(name, value, fmt::format("{} ({})", help, value))->group("Fit")->check(between(low, high)));
  };
  all.push_back(add_up_option(
      app, "--up", [&options](char up) { options.up = up; },
      "The axis of the mesh that is up: x, y, z, or auto: y or z, whichever fits better (auto)"));
  all.push_back(app.add_flag("!--no-turns", options.turns, "Do not try the mesh in four directions about what is up")
                    ->group("Fit"));
  add("--samples", options.surface_samples, "Points on the mesh's surface, 100 to 10 million", 100, 1e7);
  add("--volume-samples", options.volume_samples, "Points around it, 0 to 10 million", 0, 1e7);
  add("--alpha", options.alpha, "How much those around it count, at least 0", 0, 1e9);
  add("--sigmas", options.sigmas, "Passes, each looking nearer to the surface, 1 to 20", 1, 20);
  add("--least-sigma", options.least_sigma, "How near the last one looks, a part of the diagonal up to 1", 1e-6, 1);
  add("--fit-iterations", options.iterations, "Iterations of each pass at most", 1, 1e6);
  add("--seed", options.seed, "Of the points", 0, 4294967295.0);
  return all;
}

std::shared_ptr<Backend> backend_of(const FitOptions& options, const BackendChoice& choice) {
  const double points = options.surface_samples + options.volume_samples;
  const double count = std::min(points * options.iterations, 1.0 * std::numeric_limits<int>::max());
  return choice.for_elements(static_cast<int>(count), AutoDevices::all);
}

TemplateFit fitted(const Template& of, const MeshFile& file, const FitOptions& options, const ProgressFn& progress) {
  return naming(file.path.string(), [&] {
    TemplateFit fit = fit_template(of, file.mesh.positions, file.mesh.triangles, options, progress);
    stop_if_interrupted();
    return fit;
  });
}

std::vector<std::string> warnings_of(const TemplateFit& fit, const std::string& mesh) {
  std::vector<std::string> warnings = fit.report.warnings;
  if (fit.residual > kPoor) {
    warnings.push_back(fmt::format(
        "the template is {:.1f} % of the diagonal off {}: is it of that shape, and what is up said with --up?",
        100 * fit.residual, mesh));
  }
  if (fit.excess > kPoor) {
    warnings.push_back(
        fmt::format("the template has what {} has not: its surface is {:.1f} % of the diagonal off, by and large", mesh,
                    100 * fit.excess));
  }
  return warnings;
}

}  // namespace swage::cli
