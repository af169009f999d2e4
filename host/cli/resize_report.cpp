#include "resize_report.h"

#include <utility>

namespace swage::cli {
namespace {

using Eigen::AlignedBox3d;
using Eigen::RowVector3d;

constexpr const char* kAxes = "xyz";

Json json_of(const RowVector3d& values) { return {values[0], values[1], values[2]}; }

Json json_of(const AlignedBox3d& box) {
  return {{"low", json_of(RowVector3d(box.min().transpose()))}, {"high", json_of(RowVector3d(box.max().transpose()))}};
}

/// Of what faces or cells have along each axis.
Json statistics(const AxisValues& values) {
  Json json;
  for (int u = 0; u < 3; ++u) {
    const auto along = values.col(u);
    const auto above = static_cast<double>((along.array() > 0.5).count());
    json[std::string(1, kAxes[u])] = {{"mean", along.mean()},
                                      {"max", along.maxCoeff()},
                                      {"share_above_half", above / static_cast<double>(along.size())}};
  }
  return json;
}

void add_grid(Json& json, Resized& run) {
  const Extents& cells = run.plan.shape().cells;
  json["cells"] = {cells[0], cells[1], cells[2]};
  json["cell_count"] = cells.count();
  json["touched_cells"] = (run.plan.map().phi.array() == 1).count();
  json["vulnerability"] = {{"faces", statistics(run.plan.vulnerability().theta)},
                           {"cells", statistics(run.plan.map().theta)}};
}

AlignedBox3d box_of(const Positions& positions) {
  return {positions.colwise().minCoeff().transpose(), positions.colwise().maxCoeff().transpose()};
}

const char* to_string(ResizeAnchor anchor) {
  return anchor == ResizeAnchor::low ? "low" : anchor == ResizeAnchor::center ? "center" : "high";
}

/// Where the box is to be.
AlignedBox3d asked_box(const AlignedBox3d& rest, const ResizeTarget& target, const RowVector3d& factors) {
  AlignedBox3d box = rest;
  for (int u = 0; u < 3; ++u) {
    const ResizeAnchor anchor = target.anchors[static_cast<size_t>(u)];
    const double part = anchor == ResizeAnchor::low ? 0 : anchor == ResizeAnchor::center ? 0.5 : 1;
    const double growth = (factors[u] - 1) * rest.sizes()[u];
    box.min()[u] -= part * growth;
    box.max()[u] += (1 - part) * growth;
  }
  return box;
}

/// How far a side of the box is from its place.
double box_error(const AlignedBox3d& asked, const AlignedBox3d& box) {
  return std::max((asked.min() - box.min()).cwiseAbs().maxCoeff(), (asked.max() - box.max()).cwiseAbs().maxCoeff());
}

Json result_json(const Resized& run, size_t index, std::vector<std::string>& warnings) {
  const ResizeTarget& target = run.targets[index];
  const ResizeResult& result = run.results[index];
  const AlignedBox3d before = box_of(run.file.mesh.positions), after = box_of(result.positions);
  warnings.insert(warnings.end(), result.report.warnings.begin(), result.report.warnings.end());
  Json json;
  json["factors"] = json_of(result.factors);
  for (const ResizeAnchor anchor : target.anchors) json["anchor"].push_back(to_string(anchor));
  add_solve(json, result.report, warnings);
  json["smallest_cell_scale"] = result.least_scale;
  json["shortest_grid_edge"] = result.least_edge;
  json["kept_scale"] = json_of(result.kept_scale);
  json["scales_at_bound"] = result.scales_at_bound;
  json["edges_at_bound"] = result.edges_at_bound;
  json["box_before"] = json_of(before);
  json["box_after"] = json_of(after);
  add_changes(json, run.file.mesh, {}, result.positions, warnings);
  json["handle_error"] = box_error(asked_box(before, target, result.factors), after) / before.diagonal().norm();
  return json;
}

/// Each of several with what it took.
Json results_json(const ResizeJob& job, const Resized& run) {
  Json list = Json::array();
  for (size_t t = 0; t < run.results.size(); ++t) {
    std::vector<std::string> warnings;
    Json json = result_json(run, t, warnings);
    if (!job.output.empty()) json["output"] = numbered(job.output, t, run.results.size());
    for (const char* stage : {"scales", "assembly", "carry", "solve"}) {
      json["seconds_by_stage"][stage] = run.results[t].report.seconds.at(stage);
    }
    json["warnings"] = warnings;
    list.push_back(std::move(json));
  }
  return list;
}

/// Preparation once, and all solves.
Report costs_of(const Resized& run) {
  Report costs;
  for (const ResizeResult& result : run.results) {
    for (const auto& [stage, seconds] : result.report.seconds) {
      const bool is_solve = stage == "scales" || stage == "assembly" || stage == "carry" || stage == "solve";
      costs.seconds[stage] = seconds + (is_solve ? costs.seconds[stage] : 0);
    }
  }
  return costs;
}

/// Three properties, of the axes.
void add(std::vector<FaceValues>& faces, const std::string& name, const AxisValues& values) {
  for (int u = 0; u < 3; ++u) faces.push_back({name + "_" + kAxes[u], values.col(u)});
}

void write_grid(const std::string& path, Resized& run, const AxisValues& vertices, const AxisValues* scales) {
  if (path.empty()) return;
  const CellMap& map = run.plan.map();
  std::vector<int> cells;
  const Mesh surface = grid_surface(run.plan.shape(), map, vertices, &cells);
  std::vector<FaceValues> faces;
  add(faces, "theta", map.theta(cells, Eigen::all));
  if (scales != nullptr) add(faces, "scale", (*scales)(cells, Eigen::all));
  write_face_values(path, surface, faces);
}

}  // namespace

Json report_json(const ResizeJob& job, Resized& run, const Backend& backend, const RunSeconds& seconds) {
  std::vector<std::string> warnings = run.file.warnings;
  Json json = run_json("resize", job.mesh, run.file.mesh, "keep " + job.target.keep);
  add_backend(json, backend);
  add_grid(json, run);
  json["protections"] = Json::array();
  for (const ProtectionText& text : job.protections) json["protections"].push_back(text.words());
  if (run.results.size() == 1) json.update(result_json(run, 0, warnings));
  if (run.results.size() > 1) json["results"] = results_json(job, run);
  add_costs(json, costs_of(run), backend, seconds);
  json["warnings"] = warnings;
  return json;
}

void write_faces(const ResizeJob& job, Resized& run) {
  if (!job.vulnerability.empty()) {
    const Vulnerability& found = run.plan.vulnerability();
    std::vector<FaceValues> faces;
    add(faces, "vulnerability", found.theta);
    add(faces, "slippage", found.slippage);
    add(faces, "curvature", found.curvature);
    write_face_values(job.vulnerability, run.file.mesh, faces);
  }
  write_grid(job.grid_before, run, rest_vertices(run.plan.shape()), nullptr);
  for (size_t t = 0; t < run.results.size(); ++t) {
    const ResizeResult& result = run.results[t];
    write_grid(numbered(job.grid_after, t, run.results.size()), run, result.grid, &result.scales);
  }
}

}  // namespace swage::cli
