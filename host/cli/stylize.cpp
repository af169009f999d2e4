#include "stylize.h"

#include <utility>
#include <variant>

#include "style_choice.h"
#include "stylize_report.h"
#include "swage/polycube.h"

namespace swage::cli {
namespace {

constexpr int kAccelerated = 5;  // Passes that a start is made of.

StylizeOptions solver_options(const StylizeJob& job, const Mesh& mesh, const BackendChoice& choice) {
  StylizeOptions options;
  options.energy = energy_of(job);
  options.weights = weights_of(job);
  if (job.published) options.scale = AcapScale::paper;
  options.pass_limit = job.iterations.value_or(options.pass_limit);
  if (job.accelerate) options.acceleration_window = kAccelerated;
  options.backend = choice.for_elements(static_cast<int>(mesh.triangles.rows()), AutoDevices::all);
  spdlog::debug("local steps: {} on {}", options.backend->name(), options.backend->device());
  return options;
}

/// Prepared anew in each pass: there is no plan to keep.
StylizeResult solve_polycube(const StylizeJob& job, const Mesh& mesh, const Style& style, const Gesture& handles,
                             const std::shared_ptr<Backend>& backend, const CommonOptions& common,
                             RunSeconds& seconds) {
  PolycubeOptions options;
  options.lambda = lambda_of(job);
  options.pass_limit = job.iterations.value_or(options.pass_limit);
  options.backend = backend;
  StylizeResult result = with_progress(common, [&](const ProgressFn& progress) {
    return polycube(mesh.positions, mesh.triangles, std::get<ClosestNormals>(style), options, handles, progress);
  });
  stop_if_interrupted();
  seconds.precompute = result.report.seconds["precompute"];
  seconds.solve = result.report.seconds["solve"];
  return result;
}

StylizeResult solve(const Mesh& mesh, const Style& style, double lambda, const Gesture& handles,
                    const StylizeOptions& options, const CommonOptions& common, RunSeconds& seconds) {
  return with_progress(common, [&](const ProgressFn& progress) {
    return timed(Stylize(mesh.positions, mesh.triangles, options), progress, seconds,
                 [&](Stylize& plan) { return plan.solve(style, lambda, handles, progress); });
  });
}

Stylized measured(const MeshFile& file, const Gesture& handles, StylizeResult result,
                  std::vector<std::string> warnings) {
  const Mesh& mesh = file.mesh;
  StyleMeasures before = style_measures(mesh.positions, mesh.triangles, result.first_targets);
  StyleMeasures after = style_measures(result.positions, mesh.triangles, result.last_targets);
  return {file, handles, std::move(result), std::move(before), std::move(after), std::move(warnings)};
}

void run_sheet(const StylizeJob& job, const MeshFile& file, const Gesture& handles, const BackendChoice& choice,
               const CommonOptions& common) {
  write_png(job.sheet, style_sheet(job, file, handles, choice, common));
  spdlog::info("{}: {}", job.mesh, job.sheet);
}

void run(const StylizeJob& job, const CommonOptions& common) {
  check_job(job);
  std::optional<GestureRecipe> recipe;
  if (asks_for_handles(job.gesture)) recipe.emplace(job.gesture);
  apply(common);
  const BackendChoice choice(common);
  RunSeconds seconds;
  const Stopwatch total, read;
  const MeshFile file = read_input(job.mesh);
  const Gesture handles = recipe ? recipe->on(file) : Gesture{};
  if (!job.sheet.empty()) return run_sheet(job, file, handles, choice, common);
  std::vector<std::string> warnings;
  const Style style = style_of(job, file, warnings);
  seconds.read = read.seconds();
  stop_if_interrupted();

  StylizeOptions options = solver_options(job, file.mesh, choice);
  StylizeResult result = naming(job.mesh, [&] {
    return solve_or_fall_back(choice, options.backend, [&] {
      if (job.polycube) return solve_polycube(job, file.mesh, style, handles, options.backend, common, seconds);
      return solve(file.mesh, style, lambda_of(job), handles, options, common, seconds);
    });
  });
  warnings.insert(warnings.end(), result.report.warnings.begin(), result.report.warnings.end());
  for (const std::string& warning : warnings) spdlog::warn("{}", warning);
  warnings.insert(warnings.begin(), file.warnings.begin(), file.warnings.end());  // Told of as they were read.
  const Stylized done = measured(file, handles, std::move(result), std::move(warnings));
  const Image picture = job.picture.path.empty() ? Image() : picture_of(job, done, common);

  const Stopwatch write;
  write_result(job, file, done.result.positions);
  if (!job.picture.path.empty()) write_png(job.picture.path, picture);
  seconds.write = write.seconds();
  seconds.total = total.seconds();
  if (!job.json.empty()) write_json(job.json, report_json(job, done, *options.backend, seconds));
  spdlog::info("{}: {} passes ({}), normals {:.1f}° from their targets, {:.1f}° before, {:.2f} s", job.mesh,
               done.result.report.passes, to_string(done.result.report.stop), degrees(done.after.angle.mean),
               degrees(done.before.angle.mean), seconds.total);
}

}  // namespace

Command stylize_command(CLI::App& program, const CommonOptions& common) {
  CLI::App* app = program.add_subcommand("stylize", "Turns normals to where those of a style point; details stay");
  auto job = std::make_shared<StylizeJob>();
  add_stylize_options(*app, *job);
  return {app, [job, &common] { run(*job, common); }};
}

}  // namespace swage::cli
