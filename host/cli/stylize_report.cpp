#include "stylize_report.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <filesystem>

#include "style_choice.h"

namespace swage::cli {
namespace {

constexpr double kLeastDegrees = 5;  // Of the colour bar.

Json before_and_after(const Stylized& run, Json (*json)(const StyleMeasures&)) {
  return {{"before", json(run.before)}, {"after", json(run.after)}};
}

Json angle_json(const StyleMeasures& measures) {
  return {{"mean", degrees(measures.angle.mean)},
          {"percentile_95", degrees(measures.angle.percentile_95)},
          {"max", degrees(measures.angle.max)}};
}

Json developable_json(const StyleMeasures& measures) { return measures.developable; }

Json quality_json(const StyleMeasures& measures) {
  return {{"mean", measures.quality},
          {"least_angle_deg", degrees(measures.least_angle)},
          {"low_angle_deg", degrees(measures.low_angle)}};
}

/// Both parts of the energy of each pass.
void add_parts(Json& json, const std::vector<StylizeTerms>& passes) {
  for (size_t i = 0; i < passes.size(); ++i) {
    json["passes"][i]["shape"] = passes[i].shape;
    json["passes"][i]["normals"] = passes[i].normals;
  }
}

Panel panel_of(const Mesh& mesh, const std::string& title, std::vector<HandleMark> handles,
               const StyleMeasures& measures) {
  return {mesh, title, std::move(handles), measures.face_angles * degrees(1),
          fmt::format("mean {:.1f}°, 95 % below {:.1f}°", degrees(measures.angle.mean),
                      degrees(measures.angle.percentile_95))};
}

}  // namespace

Json report_json(const StylizeJob& job, const Stylized& run, const Backend& backend, const RunSeconds& seconds) {
  const Report& report = run.result.report;
  std::vector<std::string> warnings = run.warnings;
  Json json = run_json("stylize", job.mesh, run.file.mesh, method_of(job));
  json["style"] = style_title(job);
  json["regulariser"] = to_string(energy_of(job));
  json["weights"] = to_string(weights_of(job));
  json["lambda"] = lambda_of(job);
  if (method_of(job) == "closest") json["dynamic"] = !job.no_dynamic;
  add_backend(json, backend);
  add_solve(json, report, warnings);
  add_parts(json, run.result.passes);
  json["target_angle_deg"] = before_and_after(run, angle_json);
  json["developable_area"] = before_and_after(run, developable_json);
  json["triangle_quality"] = before_and_after(run, quality_json);
  add_changes(json, run.file.mesh, run.handles, run.result.positions, warnings);
  add_costs(json, report, backend, seconds);
  json["warnings"] = warnings;
  return json;
}

Image picture_of(const StylizeJob& job, const Stylized& run, const CommonOptions& common) {
  const Mesh& rest = run.file.mesh;
  const std::string name = std::filesystem::path(job.mesh).stem().string();
  std::vector<Panel> panels{panel_of(rest, name, handle_marks(run.handles, rest.positions, false), run.before),
                            panel_of({run.result.positions, rest.triangles}, name + ", " + style_title(job),
                                     handle_marks(run.handles, rest.positions, true), run.after)};
  RenderOptions options = render_options_of(job.picture);
  if (job.heat == "none") {
    for (Panel& panel : panels) panel.face_values.resize(0);
  } else {
    const double high = degrees(std::max(run.before.angle.percentile_95, run.after.angle.percentile_95));
    options.heat_map = {0, rounded_up(std::max(kLeastDegrees, high)), "normals to their targets, degrees"};
  }
  return drawn(panels, options, common);
}

}  // namespace swage::cli
