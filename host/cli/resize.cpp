#include "resize.h"

#include <algorithm>
#include <utility>

#include "failure.h"
#include "resize_pictures.h"
#include "resize_report.h"

namespace swage::cli {
namespace {

/// What is asked for, understood as far as that goes without the mesh.
struct Recipe {
  TargetRecipe targets;
  std::vector<ProtectionRecipe> protections;
  ResizeOptions options;

  explicit Recipe(const ResizeJob& job) : targets(job.target), options(options_of(job)) {
    for (const ProtectionText& text : job.protections) protections.emplace_back(text);
  }
};

Resize plan_of(const MeshFile& file, const ResizeOptions& options) {
  return naming(file.path.string(), [&] { return Resize(file.mesh.positions, file.mesh.triangles, options); });
}

Resized resized(const MeshFile& file, const Recipe& recipe, const CommonOptions& common, RunSeconds& seconds) {
  Resized run{file, plan_of(file, recipe.options), {}, {}};
  run.targets = recipe.targets.on(run.plan.shape(), file.path.string());
  std::vector<Protection> protections;
  for (const ProtectionRecipe& protection : recipe.protections) protections.push_back(protection.on(file));
  const size_t count = std::max<size_t>(1, run.targets.size());
  with_progress(common, [&](const ProgressFn& progress) {
    const Stopwatch precompute;
    run.plan.prepare(part_of(progress, 0, count));
    stop_if_interrupted();
    for (const Protection& protection : protections) run.plan.protect(protection);
    seconds.precompute = precompute.seconds();
    const Stopwatch solve;
    for (size_t t = 0; t < run.targets.size(); ++t) {
      run.results.push_back(run.plan.solve(run.targets[t], part_of(progress, t, count)));
      stop_if_interrupted();
    }
    seconds.solve = solve.seconds();
  });
  return run;
}

void warn(const Resized& run) {
  for (const ResizeResult& result : run.results) {
    const std::string which = run.results.size() > 1 ? words(result.factors) + ": " : "";
    for (const std::string& warning : result.report.warnings) spdlog::warn("{}{}", which, warning);
  }
}

void tell(const ResizeJob& job, const Resized& run, double seconds) {
  const Extents& cells = run.plan.shape().cells;
  const std::string grid = fmt::format("{}: {} x {} x {} cells", job.mesh, cells[0], cells[1], cells[2]);
  if (run.results.empty()) return spdlog::info("{}, {:.2f} s", grid, seconds);
  for (const ResizeResult& result : run.results) {
    spdlog::info("{}, {}: {} iterations ({}), scales from {:.3g}, {:.2f} s", grid, words(result.factors),
                 result.report.passes, to_string(result.report.stop), result.least_scale,
                 run.results.size() > 1 ? result.report.seconds.at("solve") : seconds);
  }
}

void write_results(const ResizeJob& job, const Resized& run) {
  EditFiles files = job;
  for (size_t t = 0; t < run.results.size(); ++t) {
    files.output = numbered(job.output, t, run.results.size());
    write_result(files, run.file, run.results[t].positions);
  }
}

void run(const ResizeJob& job, const CommonOptions& common) {
  check_job(job);
  Recipe recipe(job);
  apply(common);
  const BackendChoice choice(common);
  RunSeconds seconds;
  const Stopwatch total, read;
  const MeshFile file = read_input(job.mesh);
  std::shared_ptr<Backend>& backend = recipe.options.backend;
  backend = choice.for_elements(static_cast<int>(file.mesh.triangles.rows()), AutoDevices::all);
  spdlog::debug("local steps: {} on {}", backend->name(), backend->device());
  seconds.read = read.seconds();
  stop_if_interrupted();

  Resized done = solve_or_fall_back(choice, backend, [&] { return resized(file, recipe, common, seconds); });
  warn(done);
  const ResizePictures pictures = pictures_of(job, done, common);

  const Stopwatch write;
  write_results(job, done);
  write_faces(job, done);
  write_pictures(job, pictures);
  seconds.write = write.seconds();
  seconds.total = total.seconds();
  if (!job.json.empty()) write_json(job.json, report_json(job, done, *backend, seconds));
  tell(job, done, seconds.total);
}

}  // namespace

Command resize_command(CLI::App& program, const CommonOptions& common) {
  CLI::App* app = program.add_subcommand(
      "resize", "Gives a model another size; what must not distort keeps its shape, the rest takes the stretch");
  auto job = std::make_shared<ResizeJob>();
  add_resize_options(*app, *job);
  return {app, [job, &common] { run(*job, common); }};
}

}  // namespace swage::cli
