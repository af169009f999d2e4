#include "report_json.h"

#include <spdlog/fmt/fmt.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "adjacency.h"
#include "changes.h"
#include "deform.h"
#include "measures.h"
#include "swage/error.h"

namespace swage::cli {
namespace {

// A search for more takes long and says no more.
constexpr std::size_t kMostCrossings = 1'000'000;

int component_count(const Mesh& mesh) {
  const std::vector<int> component = components(mesh.triangles, static_cast<int>(mesh.positions.rows()));
  return 1 + *std::max_element(component.begin(), component.end());
}

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

void add_run(Json& json, const ReshapeJob& job, const Mesh& mesh, const Backend& backend) {
  json["command"] = "reshape";
  json["version"] = SWAGE_VERSION;
  json["input"] = job.mesh;
  json["vertices"] = mesh.positions.rows();
  json["triangles"] = mesh.triangles.rows();
  json["components"] = component_count(mesh);
  json["method"] = job.method;
  if (!deform_method(job.method)) json["solver"] = job.solver;
  json["backend"] = backend.name();
  json["device"] = backend.device();
  json["precision"] = backend.precision() == Precision::single ? "single" : "double";
  json["threads"] = threads_in_use();
}

void add_solve(Json& json, const Report& report, std::vector<std::string>& warnings) {
  json["iterations"] = report.passes;
  json["best_iteration"] = report.best_pass;
  json["stop"] = to_string(report.stop);
  json["energy"] = finite(report.energy, "energy", warnings);
  json["energy_by_term"] = Json::object();
  for (const auto& [term, energy] : report.energy_by_term) {
    json["energy_by_term"][term] = finite(energy, "energy_by_term " + term, warnings);
  }
  json["passes"] = Json::array();
  for (size_t i = 0; i < report.energies.size(); ++i) {
    json["passes"].push_back({{"energy", report.energies[i]}, {"movement", report.movements[i]}});
  }
}

void add_errors(Json& json, const Mesh& rest, const Gesture& gesture, const ReshapeResult& result,
                std::vector<std::string>& warnings) {
  auto number = [&](double value, const char* name) { return finite(value, name, warnings); };
  const double diagonal = box_diagonal(rest.positions);
  json["handle_error"] = number(largest_miss(gesture, result.positions) / diagonal, "handle_error");
  json["handle_error_unfinished"] =
      number(largest_miss(gesture, result.unfinished) / diagonal, "handle_error_unfinished");
  json["finalised"] = result.finalised;
  const Eigen::VectorXd turns = normal_turns(rest.positions, result.positions, rest.triangles);
  const Spread angle = spread(turns, area_vectors(rest.positions, rest.triangles).rowwise().norm());
  json["normal_error_deg"] = {{"mean", number(degrees(angle.mean), "normal_error_deg mean")},
                              {"percentile_95", number(degrees(angle.percentile_95), "normal_error_deg percentile_95")},
                              {"max", number(degrees(angle.max), "normal_error_deg max")}};
  json["flipped_triangles"] = flipped(turns);
}

void add_self_intersections(Json& json, const Mesh& rest, const Positions& positions,
                            std::vector<std::string>& warnings) {
  const std::optional<CrossingChange> change =
      crossing_change(rest.positions, positions, rest.triangles, kMostCrossings);
  json["new_self_intersections"] = change ? Json(change->fresh) : Json(nullptr);
  if (!change) {
    warnings.push_back(fmt::format("more than {} pairs of triangles cross: they are not counted", kMostCrossings));
  } else if (change->before > 0) {
    warnings.push_back(fmt::format("{} of triangles cross before the edit",
                                   change->before == 1 ? "1 pair" : fmt::format("{} pairs", change->before)));
  }
}

}  // namespace

Json finite(double value, const std::string& name, std::vector<std::string>& warnings) {
  if (std::isfinite(value)) return value;
  warnings.push_back(name + " is not finite");
  return nullptr;
}

Json report_json(const ReshapeJob& job, const MeshFile& file, const Gesture& gesture, const ReshapeResult& result,
                 const Backend& backend, const RunSeconds& seconds) {
  std::vector<std::string> warnings = file.warnings;
  warnings.insert(warnings.end(), result.report.warnings.begin(), result.report.warnings.end());
  Json json;
  add_run(json, job, file.mesh, backend);
  add_solve(json, result.report, warnings);
  add_errors(json, file.mesh, gesture, result, warnings);
  add_self_intersections(json, file.mesh, result.positions, warnings);
  json["seconds"] = {{"read", seconds.read},
                     {"precompute", seconds.precompute},
                     {"solve", seconds.solve},
                     {"write", seconds.write},
                     {"total", seconds.total}};
  for (const auto& [stage, spent] : result.report.seconds) json["seconds_by_stage"][stage] = spent;
  for (const auto& [part, bytes] : result.report.bytes)
    json["memory_mb_by_part"][part] = 1e-6 * static_cast<double>(bytes);
  for (const auto& [choice, path] : result.report.paths) json["paths"][choice] = path;
  const Traffic traffic = backend.traffic();
  json["traffic"] = {{"uploaded_bytes", traffic.uploaded},
                     {"downloaded_bytes", traffic.downloaded},
                     {"build_seconds", traffic.build_seconds}};
  json["peak_memory_mb"] = peak_memory_mb();
  json["warnings"] = warnings;
  return json;
}

void write_json(const std::string& path, const Json& json) {
  if (path.empty()) return;
  // Names of files and labels need not be UTF-8.
  const std::string text = json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  if (path == kStdout) return write_stdout(text);
  write_file(path, text);
}

}  // namespace swage::cli
