// `swage stylize --style-sheet`: one mesh under six styles.
#include <filesystem>
#include <vector>

#include "style_choice.h"

namespace swage::cli {
namespace {

std::vector<StylizeJob> jobs_of_sheet(const StylizeJob& job) {
  std::vector<StylizeJob> jobs;
  for (const char* style : {"cube", "octahedron", "icosahedron", "prism6", "rounded-cube"}) {
    jobs.push_back(job);
    jobs.back().style = style;
  }
  jobs.push_back(job);
  jobs.back().developable = true;
  return jobs;
}

}  // namespace

Image style_sheet(const StylizeJob& job, const MeshFile& file, const Gesture& handles, const BackendChoice& choice,
                  const CommonOptions& common) {
  const Mesh& rest = file.mesh;
  std::vector<Panel> panels{
      {rest, std::filesystem::path(job.mesh).stem().string(), handle_marks(handles, rest.positions, false), {}, {}}};
  StylizeOptions options;
  options.pass_limit = job.iterations.value_or(options.pass_limit);
  options.backend = choice.for_elements(static_cast<int>(rest.triangles.rows()), AutoDevices::all);
  for (const StylizeJob& one : jobs_of_sheet(job)) {
    options.energy = energy_of(one);
    std::vector<std::string> none;  // Of these styles.
    const Style style = style_of(one, file, none);
    const StylizeResult result = solve_or_fall_back(choice, options.backend, [&] {
      return with_progress(common, [&](const ProgressFn& progress) {
        return stylize(rest.positions, rest.triangles, style, lambda_of(one), options, handles, progress);
      });
    });
    stop_if_interrupted();
    panels.push_back(
        {{result.positions, rest.triangles}, style_title(one), handle_marks(handles, rest.positions, true), {}, {}});
  }
  return drawn(panels, render_options_of(job.picture), common);
}

}  // namespace swage::cli
