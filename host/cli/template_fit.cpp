// `swage template fit`: the parameters with which a template is most like a mesh.
#include <algorithm>
#include <memory>
#include <utility>

#include "failure.h"
#include "fit_file.h"
#include "fit_picture.h"
#include "template.h"
#include "template_choice.h"
#include "template_fitting.h"
#include "template_report.h"
#include "template_surface.h"

namespace swage::cli {
namespace {

struct FitJob : EditFiles {  // -o is the fitted surface.
  std::string name;
  FitOptions options;
  int resolution = 128;
  PictureOptions picture;
};

void check_job(const FitJob& job) {
  check_outputs(job);
  check(job.picture);
  check_different({{"-o", job.output},
                   {"--json", job.json},
                   {"--picture", job.picture.path},
                   {"MESH", job.mesh},
                   {"--template", file_of_template(job.name)}});
}

/// A run that is done.
struct FitRun {
  const MeshFile& file;
  const Template& of;
  TemplateFit fit;
  FitMiss miss;
  Mesh surface;  ///< In the mesh's place; none where it is not asked for.
  std::vector<std::string> warnings;
};

FitRun fit_run(const FitJob& job, const MeshFile& file, const Template& of, const std::shared_ptr<Backend>& backend,
               const CommonOptions& common, RunSeconds& seconds) {
  FitOptions options = job.options;
  options.backend = backend;
  const Stopwatch solve;
  FitRun run{file, of, {}, {}, {}, {}};
  run.fit = with_progress(common, [&](const ProgressFn& progress) { return fitted(of, file, options, progress); });
  run.miss = miss_of(of, run.fit, file.mesh, *backend);
  if (!job.output.empty() || !job.picture.path.empty()) {
    run.surface = surface_of(of, run.fit.parameters, {job.resolution, backend}, common);
    run.surface.positions = run.fit.pose.back(run.surface.positions);
  }
  seconds.solve = solve.seconds();
  run.warnings = warnings_of(run.fit, job.mesh);
  return run;
}

Json report_json(const FitJob& job, const FitRun& run, const Backend& backend, const RunSeconds& seconds) {
  std::vector<std::string> warnings = run.file.warnings;
  warnings.insert(warnings.end(), run.warnings.begin(), run.warnings.end());
  Json json = run_json("template fit", job.mesh, run.file.mesh, "L-BFGS-B");
  add_fit(json, job.name, run.of, run.fit.parameters, run.fit.pose);
  add_fit_quality(json, run.of, run.fit, warnings);
  add_backend(json, backend);
  add_solve(json, run.fit.report, warnings);
  json["handle_error"] = finite(run.fit.largest, "handle_error", warnings);
  json["normal_error_deg"] = {{"mean", degrees(run.miss.angle.mean)},
                              {"percentile_95", degrees(run.miss.angle.percentile_95)},
                              {"max", degrees(run.miss.angle.max)}};
  add_costs(json, run.fit.report, backend, seconds);
  json["warnings"] = warnings;
  add_document(json, run.of);
  return json;
}

void tell(const FitJob& job, const FitRun& run, double seconds) {
  if (job.json != kStdout && job.output != kStdout) write_stdout(table_of(run.of, run.fit.parameters));
  spdlog::info(
      "{}: {} off by {:.2f} % of the diagonal, at most {:.1f} %, and its surface by {:.2f} %; {} passes, {:.2f} s",
      job.mesh, job.name, 100 * run.fit.residual, 100 * run.fit.largest, 100 * run.fit.excess, run.fit.report.passes,
      seconds);
}

void run(const FitJob& job, const CommonOptions& common) {
  check_job(job);
  apply(common);
  const Template of = template_named(job.name);
  const BackendChoice choice(common);
  RunSeconds seconds;
  const Stopwatch total, read;
  const MeshFile file = read_input(job.mesh);
  std::shared_ptr<Backend> backend = backend_of(job.options, choice);
  spdlog::debug("local steps: {} on {}", backend->name(), backend->device());
  seconds.read = read.seconds();
  stop_if_interrupted();

  const FitRun done =
      solve_or_fall_back(choice, backend, [&] { return fit_run(job, file, of, backend, common, seconds); });
  for (const std::string& warning : done.warnings) spdlog::warn("{}", warning);
  const Image picture =
      job.picture.path.empty()
          ? Image()
          : picture_of_fit(job.picture, {job.mesh, file.mesh, of, done.fit, done.miss, done.surface}, common);

  const Stopwatch write;
  write_surface(job.output, done.surface);
  if (!job.picture.path.empty()) write_png(job.picture.path, picture);
  seconds.write = write.seconds();
  seconds.total = total.seconds();
  if (!job.json.empty()) write_json(job.json, report_json(job, done, *backend, seconds));
  tell(job, done, seconds.total);
}

}  // namespace

Command template_fit_command(CLI::App& group, const CommonOptions& common) {
  CLI::App* app = group.add_subcommand("fit", "Finds the parameters with which a template is most like a mesh");
  auto job = std::make_shared<FitJob>();
  add_edit_files(*app, *job, "The mesh to fit the template to: .obj .ply .stl .off");
  app->get_option("--output")
      ->description("The fitted surface, in the mesh's place, format by extension; - for stdout, as OBJ");
  app->get_option("--json")->description(
      "The fit and the report of the run, for --fit of the other commands; - for stdout, instead of the table");
  add_template_option(*app, job->name)->required();
  add_fitting_options(*app, job->options);
  add_resolution_option(*app, job->resolution);
  CLI::Option* const picture = add_picture_option(
      *app, job->picture, "The mesh, the fitted surface, and both in one place, coloured by how far they are apart");
  for (CLI::Option* option : add_eye_options(*app, job->picture, "--picture-size")) option->needs(picture);
  return {app, [job, &common] { run(*job, common); }};
}

}  // namespace swage::cli
