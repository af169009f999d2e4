// `swage template retarget`: a mesh takes the parameters and the place of a template in another mesh.
#include <filesystem>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>

#include "failure.h"
#include "template.h"
#include "template_choice.h"
#include "template_editing.h"
#include "template_fitting.h"
#include "template_json.h"
#include "template_surface.h"

namespace swage::cli {
namespace {

struct RetargetJob : EditFiles {  // MESH is the source.
  std::string target, name, source_fit, target_fit;
  std::optional<char> target_up;  ///< As that of the source where it is not given.
  FitOptions fitting;
  TemplateEditOptions options;
  PictureOptions picture;

  FitOptions fitting_of_target() const {
    FitOptions of_target = fitting;
    of_target.up = target_up.value_or(fitting.up);
    return of_target;
  }
};

void check_job(const RetargetJob& job) {
  check_outputs(job);
  check(job.picture);
  check_writes({job.output, job.json, job.picture.path});
  check_apart({{"-o", job.output}, {"--json", job.json}, {"--picture", job.picture.path}},
              {{"TARGET", job.target},
               {"--source-fit", job.source_fit},
               {"--target-fit", job.target_fit},
               {"--template", file_of_template(job.name)}});
  check_apart({{"--json", job.json}, {"--picture", job.picture.path}}, {{"SOURCE", job.mesh}});
}

/// What is known before the meshes are read: both of one template.
struct KnownFits {
  KnownFit source, target;
};

KnownFits known_fits(const RetargetJob& job) {
  if (job.name.empty() && job.source_fit.empty() && !job.target_fit.empty()) {
    const KnownFit target = known_fit("", job.target_fit);
    return {{target.name, target.of, std::nullopt}, target};
  }
  const KnownFit source = known_fit(job.name, job.source_fit);
  KnownFits known{source, {source.name, source.of, std::nullopt}};
  if (job.target_fit.empty()) return known;
  known.target.file = read_fit(job.target_fit);
  known.target.file->check_is_of(source.of, source.name);
  return known;
}

/// A run that is done.
struct RetargetRun {
  const MeshFile &source, &target;
  const KnownFits& known;
  TemplateFit source_fit, target_fit;
  TemplateEditResult edit;  ///< Where the target lies.
  std::vector<std::string> warnings;

  /// From where the source lies to where the target does.
  Positions carried(const PositionsRef& positions) const {
    return target_fit.pose.back(source_fit.pose.into(positions));
  }
};

RetargetRun retarget_run(const RetargetJob& job, const MeshFile& source, const MeshFile& target, const KnownFits& known,
                         const BackendChoice& choice, const std::shared_ptr<Backend>& backend,
                         const CommonOptions& common, RunSeconds& seconds) {
  TemplateEditOptions options = job.options;
  options.backend = backend;
  RetargetRun run{source, target, known, {}, {}, {}, {}};
  with_progress(common, [&](const ProgressFn& progress) {
    const Stopwatch precompute;
    run.source_fit = fit_of(known.source, job.fitting, source, choice, part_of(progress, 0, 4));
    run.target_fit = fit_of(known.target, job.fitting_of_target(), target, choice, part_of(progress, 1, 4));
    TemplateEdit edit = edit_of(known.source.of, run.source_fit, source, options);
    edit.prepare(part_of(progress, 2, 4));
    stop_if_interrupted();
    seconds.precompute = precompute.seconds();
    const Stopwatch solve;
    run.edit = edit.solve(run.target_fit.parameters, part_of(progress, 3, 4));
    stop_if_interrupted();
    seconds.solve = solve.seconds();
  });
  run.edit.positions = run.carried(run.edit.positions);
  for (const auto& [which, fit, mesh] :
       {std::tuple(&known.source, &run.source_fit, &source), std::tuple(&known.target, &run.target_fit, &target)}) {
    for (const std::string& warning : warnings_of(*which, *fit, *mesh)) run.warnings.push_back(warning);
  }
  run.warnings.insert(run.warnings.end(), run.edit.report.warnings.begin(), run.edit.report.warnings.end());
  return run;
}

Image picture_of(const RetargetJob& job, const RetargetRun& run, const CommonOptions& common) {
  if (job.picture.path.empty()) return {};
  const Mesh& rest = run.source.mesh;
  const auto stem = [](const std::string& path) { return std::filesystem::path(path).stem().string(); };
  return drawn(
      {{{run.carried(rest.positions), rest.triangles}, stem(job.mesh), {}, {}, "before, in the target's place"},
       {run.target.mesh, stem(job.target), {}, {}, "target"},
       {{run.edit.positions, rest.triangles}, stem(job.mesh), {}, {}, "after"}},
      render_options_of(job.picture, up_of(run.known.target.of, run.target_fit.pose)), common);
}

/// A fit of the result too.
Json report_json(const RetargetJob& job, const RetargetRun& run, const Backend& backend, const RunSeconds& seconds) {
  std::vector<std::string> warnings = run.source.warnings;
  warnings.insert(warnings.end(), run.target.warnings.begin(), run.target.warnings.end());
  warnings.insert(warnings.end(), run.warnings.begin(), run.warnings.end());
  const Template& of = run.known.source.of;
  Json json = run_json("template retarget", job.mesh, run.source.mesh, "local maps");
  json["target"] = job.target;
  add_backend(json, backend);
  add_fit(json, run.known.source.name, of, run.target_fit.parameters, run.target_fit.pose);
  json["parameters_before"] = values_json(of, run.source_fit.parameters);
  json["pose_before"] = pose_json(run.source_fit.pose);
  json["source_fit"] = source_json(run.known.source, run.source_fit, warnings);
  json["target_fit"] = source_json(run.known.target, run.target_fit, warnings);
  // Of what changed beside the place.
  add_edit(json, {run.carried(run.source.mesh.positions), run.source.mesh.triangles}, run.edit, warnings);
  add_costs(json, run.edit.report, backend, seconds);
  json["warnings"] = warnings;
  add_document(json, of);
  return json;
}

void run(const RetargetJob& job, const CommonOptions& common) {
  check_job(job);
  apply(common);
  const KnownFits known = known_fits(job);
  const BackendChoice choice(common);
  RunSeconds seconds;
  const Stopwatch total, read;
  const MeshFile source = read_input(job.mesh), target = read_input(job.target);
  std::shared_ptr<Backend> backend =
      choice.for_elements(static_cast<int>(source.mesh.triangles.rows()), AutoDevices::all);
  spdlog::debug("local steps: {} on {}", backend->name(), backend->device());
  seconds.read = read.seconds();
  stop_if_interrupted();

  const RetargetRun done = solve_or_fall_back(
      choice, backend, [&] { return retarget_run(job, source, target, known, choice, backend, common, seconds); });
  for (const std::string& warning : done.warnings) spdlog::warn("{}", warning);
  const Image picture = picture_of(job, done, common);

  const Stopwatch write;
  write_result(job, source, done.edit.positions);
  if (!job.picture.path.empty()) write_png(job.picture.path, picture);
  seconds.write = write.seconds();
  seconds.total = total.seconds();
  if (!job.json.empty()) write_json(job.json, report_json(job, done, *backend, seconds));
  spdlog::info("{} to {}: {} passes ({}), {:.3f} % of the diagonal off the template, at most {:.2f} %, {:.2f} s",
               job.mesh, job.target, done.edit.report.passes, to_string(done.edit.report.stop),
               100 * done.edit.residual, 100 * done.edit.largest, seconds.total);
}

void refuse_fitting_of_none(const RetargetJob& job, const std::vector<CLI::Option*>& fitting) {
  if (job.source_fit.empty() || job.target_fit.empty()) return;
  for (const CLI::Option* option : fitting) {
    if (option->count() == 0) continue;
    throw WrongUsage(option->get_name() + ": is of a fit, and both are given: leave it out, or one of them");
  }
}

}  // namespace

Command template_retarget_command(CLI::App& group, const CommonOptions& common) {
  CLI::App* app = group.add_subcommand("retarget", "Gives a mesh the parameters, the place and the size of another");
  auto job = std::make_shared<RetargetJob>();
  app->add_option("SOURCE", job->mesh, "The mesh to edit: .obj .ply .stl .off")->required();
  app->add_option("TARGET", job->target, "The mesh that it is to be like, a scan for example")->required();
  app->add_option("-o,--output", job->output, "Result mesh, format by extension; - for stdout")->type_name("FILE");
  app->add_option("--json", job->json, "Report of the run, a fit to go on from; - for stdout")->type_name("FILE");
  add_template_option(*app, job->name, "; a fit's own where that is given");
  app->add_option("--source-fit", job->source_fit,
                  "The report of `swage template fit` on the source; else it is fitted on the spot")
      ->type_name("FIT.json");
  CLI::Option* const target_fit =
      app->add_option("--target-fit", job->target_fit, "The same of the target")->type_name("FIT.json");
  const std::vector<CLI::Option*> fitting = add_fitting_options(*app, job->fitting);
  add_up_option(
      *app, "--target-up", [&target_up = job->target_up](char up) { target_up = up; }, "That of the target (as --up)")
      ->excludes(target_fit);
  add_editing_options(*app, job->options);
  CLI::Option* const picture = add_picture_option(*app, job->picture, "Source, target and result, side by side");
  for (CLI::Option* option : add_eye_options(*app, job->picture, "--picture-size")) option->needs(picture);
  return {app, [job, fitting, &common] {
            refuse_fitting_of_none(*job, fitting);
            run(*job, common);
          }};
}

}  // namespace swage::cli
