// `swage template edit`: a mesh follows the parameters of a template that was fitted to it.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

#include "failure.h"
#include "picture_fit.h"
#include "template.h"
#include "template_choice.h"
#include "template_editing.h"
#include "template_json.h"
#include "template_surface.h"

namespace swage::cli {
namespace {

struct EditJob : EditFiles {
  FitSource source;
  SettingOptions settings;
  TemplateEditOptions options;
  PictureOptions picture;
};

void check_job(const EditJob& job) {
  check_outputs(job);
  check(job.picture);
  check_writes({job.output, job.json, job.picture.path});
}

/// The mesh itself may be overwritten where there is one result.
void check_names(const EditJob& job, size_t count) {
  if (job.output == kStdout && count > 1) {
    throw WrongUsage("-o -: several results do not go to stdout: name a file, which is numbered");
  }
  std::vector<Output> outputs = {{"--json", job.json}, {"--picture", job.picture.path}};
  for (size_t r = 0; r < count; ++r) outputs.push_back({"-o", numbered(job.output, r, count)});
  check_apart(outputs, {{"--fit", job.source.file}, {"--template", file_of_template(job.source.name)}});
  if (count == 1) outputs.pop_back();
  check_apart(outputs, {{"MESH", job.mesh}});
}

/// A run that is done.
struct EditRun {
  const MeshFile& file;
  const KnownFit& known;
  const Settings& settings;
  TemplateFit fit;
  std::vector<Eigen::VectorXd> targets;
  std::vector<TemplateEditResult> results;  ///< One of each target.
  std::vector<std::string> warnings;        ///< But for those of results.
};

EditRun edit_run(const EditJob& job, const MeshFile& file, const KnownFit& known, const Settings& settings,
                 const BackendChoice& choice, const std::shared_ptr<Backend>& backend, const CommonOptions& common,
                 RunSeconds& seconds) {
  TemplateEditOptions options = job.options;
  options.backend = backend;
  EditRun run{file, known, settings, {}, {}, {}, {}};
  const size_t count = settings.count(), parts = count + 2;
  with_progress(common, [&](const ProgressFn& progress) {
    const Stopwatch precompute;
    run.fit = fit_of(known, job.source.options, file, choice, part_of(progress, 0, parts));
    for (size_t r = 0; r < count; ++r) run.targets.push_back(settings.on(run.fit.parameters, r));
    TemplateEdit edit = edit_of(known.of, run.fit, file, options);
    edit.prepare(part_of(progress, 1, parts));
    stop_if_interrupted();
    seconds.precompute = precompute.seconds();
    const Stopwatch solve;
    for (size_t r = 0; r < count; ++r) {
      run.results.push_back(edit.solve(run.targets[r], part_of(progress, r + 2, parts)));
      stop_if_interrupted();
    }
    seconds.solve = solve.seconds();
  });
  run.warnings = warnings_of(known, run.fit, file);
  if (!settings.any()) run.warnings.push_back("nothing is set with --set: the mesh stays as it is");
  return run;
}

/// Where there are several, by what is set.
std::string which(const EditRun& run, size_t result) {
  return run.results.size() > 1 ? run.settings.words(result) + ": " : "";
}

void warn(const EditRun& run) {
  for (const std::string& warning : run.warnings) spdlog::warn("{}", warning);
  for (size_t r = 0; r < run.results.size(); ++r) {
    for (const std::string& warning : run.results[r].report.warnings) spdlog::warn("{}{}", which(run, r), warning);
  }
}

void tell(const EditJob& job, const EditRun& run, double seconds) {
  for (size_t r = 0; r < run.results.size(); ++r) {
    const TemplateEditResult& result = run.results[r];
    spdlog::info("{}, {}{} passes ({}), {:.3f} % of the diagonal off the template, at most {:.2f} %, {:.2f} s",
                 job.mesh, which(run, r), result.report.passes, to_string(result.report.stop), 100 * result.residual,
                 100 * result.largest, seconds);
  }
}

Image picture_of(const EditJob& job, const EditRun& run, const CommonOptions& common) {
  if (job.picture.path.empty()) return {};
  const Mesh& rest = run.file.mesh;
  std::vector<Panel> panels{{rest, std::filesystem::path(job.mesh).stem().string(), {}, {}, "before"}};
  for (size_t r = 0; r < run.results.size(); ++r) {
    panels.push_back({{run.results[r].positions, rest.triangles}, run.settings.words(r), {}, {}, "after"});
  }
  return drawn(panels, render_options_of(job.picture, up_of(run.known.of, run.fit.pose)), common);
}

void add_result(Json& json, const EditRun& run, size_t result, std::vector<std::string>& warnings) {
  const TemplateEditResult& one = run.results[result];
  warnings.insert(warnings.end(), one.report.warnings.begin(), one.report.warnings.end());
  json["set"] = run.settings.words(result);
  json["parameters"] = values_json(run.known.of, run.targets[result]);
  add_edit(json, run.file.mesh, one, warnings);
}

/// Each of several with what it took.
Json results_json(const EditJob& job, const EditRun& run) {
  Json list = Json::array();
  for (size_t r = 0; r < run.results.size(); ++r) {
    std::vector<std::string> warnings;
    Json json;
    add_result(json, run, r, warnings);
    if (!job.output.empty()) json["output"] = numbered(job.output, r, run.results.size());
    for (const auto& [stage, spent] : run.results[r].report.seconds) json["seconds_by_stage"][stage] = spent;
    json["warnings"] = warnings;
    list.push_back(std::move(json));
  }
  return list;
}

/// Of one result on the top level, which makes it a fit of that, of several in a list.
Json report_json(const EditJob& job, const EditRun& run, const Backend& backend, const RunSeconds& seconds) {
  std::vector<std::string> warnings = run.file.warnings;
  warnings.insert(warnings.end(), run.warnings.begin(), run.warnings.end());
  Json json = run_json("template edit", job.mesh, run.file.mesh, "local maps");
  add_backend(json, backend);
  json["template"] = run.known.name;
  json["fit"] = source_json(run.known, run.fit, warnings);
  json["parameters_before"] = values_json(run.known.of, run.fit.parameters);
  json["pose"] = pose_json(run.fit.pose);
  Report costs;
  if (run.results.size() == 1) {
    add_result(json, run, 0, warnings);
    costs = run.results.front().report;
  } else {
    json["results"] = results_json(job, run);
  }
  add_costs(json, costs, backend, seconds);
  json["warnings"] = warnings;
  add_document(json, run.known.of);
  return json;
}

void write_results(const EditJob& job, const EditRun& run) {
  EditFiles files = job;
  for (size_t r = 0; r < run.results.size(); ++r) {
    files.output = numbered(job.output, r, run.results.size());
    write_result(files, run.file, run.results[r].positions);
  }
}

void run(const EditJob& job, const CommonOptions& common) {
  check_job(job);
  apply(common);
  const KnownFit known = known_fit(job.source.name, job.source.file);
  const Settings settings(job.settings, known.of);
  if (known.file) settings.on(known.file->parameters);
  check_names(job, settings.count());
  const BackendChoice choice(common);
  RunSeconds seconds;
  const Stopwatch total, read;
  const MeshFile file = read_input(job.mesh);
  std::shared_ptr<Backend> backend =
      choice.for_elements(static_cast<int>(file.mesh.triangles.rows()), AutoDevices::all);
  spdlog::debug("local steps: {} on {}", backend->name(), backend->device());
  seconds.read = read.seconds();
  stop_if_interrupted();

  const EditRun done = solve_or_fall_back(
      choice, backend, [&] { return edit_run(job, file, known, settings, choice, backend, common, seconds); });
  warn(done);
  const Image picture = picture_of(job, done, common);

  const Stopwatch write;
  write_results(job, done);
  if (!job.picture.path.empty()) write_png(job.picture.path, picture);
  seconds.write = write.seconds();
  seconds.total = total.seconds();
  if (!job.json.empty()) write_json(job.json, report_json(job, done, *backend, seconds));
  tell(job, done, seconds.total);
}

}  // namespace

Command template_edit_command(CLI::App& group, const CommonOptions& common) {
  CLI::App* app = group.add_subcommand("edit", "Moves a template's parameters, and the mesh that it lies in follows");
  auto job = std::make_shared<EditJob>();
  add_edit_files(*app, *job, "The mesh to edit: .obj .ply .stl .off");
  app->get_option("--output")
      ->description("Result mesh, format by extension; - for stdout. Of several results a.obj is a_1.obj, a_2.obj ...");
  app->get_option("--json")->description("Report of the run, of one result a fit to go on from; - for stdout");
  add_fit_source(*app, job->source);
  add_setting_options(*app, job->settings, "as they were fitted");
  app->get_option("--set")->description(app->get_option("--set")->get_description() +
                                        "; with several values, such as width*=1.5,2, there is a result for each");
  add_editing_options(*app, job->options);
  CLI::Option* const picture = add_picture_option(*app, job->picture, "The mesh before and after, side by side");
  for (CLI::Option* option : add_eye_options(*app, job->picture, "--picture-size")) option->needs(picture);
  return {app, [job, &common] { run(*job, common); }};
}

}  // namespace swage::cli
