// `swage template interpolate`: a sequence of meshes from one fit's parameters to another's.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <regex>
#include <utility>

#include "failure.h"
#include "template.h"
#include "template_choice.h"
#include "template_editing.h"
#include "template_json.h"
#include "template_surface.h"

namespace swage::cli {
namespace {

constexpr int kMostFrames = 1000;
constexpr int kMostPanels = 8;  // Of the picture.

struct InterpolateJob : EditFiles {
  FitSource source;
  std::string to;  ///< A fit; empty where only settings say where to.
  SettingOptions settings;
  int frames = 10;
  TemplateEditOptions options;
  PictureOptions picture;
};

/// Of a frame, from 0: in place of %d or %03d, or else before the extension; wide enough to be sorted by name.
std::string frame_path(const std::string& path, int frame, int count) {
  static const std::regex kPlace("%(0?)([0-9]?)d");
  if (path.empty()) return path;
  const std::filesystem::path file(path);
  const std::string name = file.filename().string(), number = std::to_string(frame + 1);
  std::smatch found;
  const bool is_told = std::regex_search(name, found, kPlace);
  const size_t width = is_told ? (found[2].length() > 0 ? std::stoul(found[2]) : 1) : std::to_string(count).size();
  const std::string padded = std::string(width - std::min(width, number.size()), '0') + number;
  const std::string numbered = is_told ? found.prefix().str() + padded + found.suffix().str()
                                       : file.stem().string() + "_" + padded + file.extension().string();
  return std::filesystem::path(file).replace_filename(numbered).string();
}

void check_job(const InterpolateJob& job) {
  EditFiles first = job;
  first.output = frame_path(job.output, 0, job.frames);
  if (job.output == kStdout)
    throw WrongUsage("-o -: several meshes do not go to stdout: name a file, which is numbered");
  check_outputs(first);
  check(job.picture);
  check_writes({job.output, job.json, job.picture.path});
  if (job.to.empty() && job.settings.texts.empty()) {
    throw WrongUsage("where to? name another fit with --to FIT.json, or parameters with --set, such as --set width*=2");
  }
  std::vector<Output> others = {{"MESH", job.mesh},
                                {"--fit", job.source.file},
                                {"--to", job.to},
                                {"--template", file_of_template(job.source.name)}};
  check_apart({{"--json", job.json}, {"--picture", job.picture.path}}, others);
  others.insert(others.end(), {{"--json", job.json}, {"--picture", job.picture.path}});
  for (int f = 0; f < job.frames; ++f) check_apart({{"-o", frame_path(job.output, f, job.frames)}}, others);
}

/// A run that is done.
struct InterpolateRun {
  const MeshFile& file;
  const KnownFit& known;
  TemplateFit fit;
  Eigen::VectorXd target;
  std::vector<TemplateEditResult> frames;
  std::vector<std::string> warnings;  ///< But for those of frames.

  Eigen::VectorXd parameters(int frame, int count) const {
    return fit.parameters + (target - fit.parameters) * frame / (count - 1);
  }
};

InterpolateRun interpolate_run(const InterpolateJob& job, const MeshFile& file, const KnownFit& known,
                               const std::optional<FitFile>& to, const Settings& settings, const BackendChoice& choice,
                               const std::shared_ptr<Backend>& backend, const CommonOptions& common,
                               RunSeconds& seconds) {
  TemplateEditOptions options = job.options;
  options.backend = backend;
  InterpolateRun run{file, known, {}, {}, {}, {}};
  with_progress(common, [&](const ProgressFn& progress) {
    const Stopwatch precompute;
    run.fit = fit_of(known, job.source.options, file, choice, part_of(progress, 0, 3));
    run.target = settings.on(to ? to->parameters : run.fit.parameters);
    TemplateEdit edit = edit_of(known.of, run.fit, file, options);
    edit.prepare(part_of(progress, 1, 3));
    stop_if_interrupted();
    seconds.precompute = precompute.seconds();
    const Stopwatch solve;
    run.frames = interpolate(edit, run.fit.parameters, run.target, job.frames, part_of(progress, 2, 3));
    stop_if_interrupted();
    seconds.solve = solve.seconds();
  });
  run.warnings = warnings_of(known, run.fit, file);
  return run;
}

void warn(const InterpolateRun& run) {
  for (const std::string& warning : run.warnings) spdlog::warn("{}", warning);
  for (size_t f = 0; f < run.frames.size(); ++f) {
    for (const std::string& warning : run.frames[f].report.warnings) spdlog::warn("frame {}: {}", f + 1, warning);
  }
}

/// The first, the last and some between.
Image picture_of(const InterpolateJob& job, const InterpolateRun& run, const CommonOptions& common) {
  if (job.picture.path.empty()) return {};
  const int count = static_cast<int>(run.frames.size()), shown = std::min(count, kMostPanels);
  std::vector<Panel> panels;
  for (int p = 0; p < shown; ++p) {
    const int frame = p * (count - 1) / (shown - 1);
    panels.push_back({{run.frames[static_cast<size_t>(frame)].positions, run.file.mesh.triangles},
                      fmt::format("{} of {}", frame + 1, count),
                      {},
                      {},
                      {}});
  }
  return drawn(panels, render_options_of(job.picture, up_of(run.known.of, run.fit.pose)), common);
}

Json frames_json(const InterpolateJob& job, const InterpolateRun& run) {
  Json list = Json::array();
  for (int f = 0; f < job.frames; ++f) {
    const TemplateEditResult& frame = run.frames[static_cast<size_t>(f)];
    std::vector<std::string> warnings = frame.report.warnings;
    Json json;
    if (!job.output.empty()) json["output"] = frame_path(job.output, f, job.frames);
    json["parameters"] = values_json(run.known.of, run.parameters(f, job.frames));
    add_edit(json, run.file.mesh, frame, warnings);
    json["warnings"] = warnings;
    list.push_back(std::move(json));
  }
  return list;
}

Json report_json(const InterpolateJob& job, const InterpolateRun& run, const Backend& backend,
                 const RunSeconds& seconds) {
  std::vector<std::string> warnings = run.file.warnings;
  warnings.insert(warnings.end(), run.warnings.begin(), run.warnings.end());
  Json json = run_json("template interpolate", job.mesh, run.file.mesh, "local maps");
  add_backend(json, backend);
  json["template"] = run.known.name;
  json["fit"] = source_json(run.known, run.fit, warnings);
  if (!job.to.empty()) json["to"] = job.to;
  json["pose"] = pose_json(run.fit.pose);
  json["frames"] = frames_json(job, run);
  add_costs(json, {}, backend, seconds);
  json["warnings"] = warnings;
  return json;
}

void write_frames(const InterpolateJob& job, const InterpolateRun& run) {
  EditFiles files = job;
  for (int f = 0; f < job.frames; ++f) {
    files.output = frame_path(job.output, f, job.frames);
    write_result(files, run.file, run.frames[static_cast<size_t>(f)].positions);
  }
}

std::optional<FitFile> known_target(const InterpolateJob& job, const KnownFit& known) {
  if (job.to.empty()) return std::nullopt;
  FitFile to = read_fit(job.to);
  to.check_is_of(known.of, known.name);
  return to;
}

void run(const InterpolateJob& job, const CommonOptions& common) {
  check_job(job);
  apply(common);
  const KnownFit known = known_fit(job.source.name, job.source.file);
  const std::optional<FitFile> to = known_target(job, known);
  const Settings settings(job.settings, known.of);
  settings.check_single();
  const BackendChoice choice(common);
  RunSeconds seconds;
  const Stopwatch total, read;
  const MeshFile file = read_input(job.mesh);
  std::shared_ptr<Backend> backend =
      choice.for_elements(static_cast<int>(file.mesh.triangles.rows()), AutoDevices::all);
  spdlog::debug("local steps: {} on {}", backend->name(), backend->device());
  seconds.read = read.seconds();
  stop_if_interrupted();

  const InterpolateRun done = solve_or_fall_back(choice, backend, [&] {
    return interpolate_run(job, file, known, to, settings, choice, backend, common, seconds);
  });
  warn(done);
  const Image picture = picture_of(job, done, common);

  const Stopwatch write;
  write_frames(job, done);
  if (!job.picture.path.empty()) write_png(job.picture.path, picture);
  seconds.write = write.seconds();
  seconds.total = total.seconds();
  if (!job.json.empty()) write_json(job.json, report_json(job, done, *backend, seconds));
  spdlog::info("{}: {} meshes, the last {:.3f} % of the diagonal off the template, {:.2f} s", job.mesh, job.frames,
               100 * done.frames.back().residual, seconds.total);
}

}  // namespace

Command template_interpolate_command(CLI::App& group, const CommonOptions& common) {
  CLI::App* app = group.add_subcommand("interpolate", "Makes a sequence of meshes between two fits");
  auto job = std::make_shared<InterpolateJob>();
  add_edit_files(*app, *job, "The mesh to edit: .obj .ply .stl .off");
  app->get_option("--output")
      ->description(
          "Result meshes, format by extension: a_%03d.obj is a_001.obj, a_002.obj ...; so is a.obj, with as many "
          "digits as are needed");
  add_fit_source(*app, job->source);
  app->add_option("--to", job->to, "The fit at whose parameters the sequence ends, of another mesh for example")
      ->type_name("FIT.json");
  add_setting_options(*app, job->settings, "as in --to or else as fitted");
  app->get_option("--set")->description("Parameters at the end of the sequence, besides --to or in its place");
  app->add_option("--frames", job->frames, "Meshes, the first and the last among them, 2 to 1000 (10)")
      ->check(between(2, kMostFrames))
      ->type_name("N");
  add_editing_options(*app, job->options);
  CLI::Option* const picture = add_picture_option(*app, job->picture, "Some of the meshes, at most eight");
  for (CLI::Option* option : add_eye_options(*app, job->picture, "--picture-size")) option->needs(picture);
  return {app, [job, &common] { run(*job, common); }};
}

}  // namespace swage::cli
