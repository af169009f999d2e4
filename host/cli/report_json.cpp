#include "report_json.h"

#include <spdlog/fmt/fmt.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "adjacency.h"
#include "changes.h"
#include "measures.h"
#include "options.h"
#include "swage/compare.h"
#include "swage/error.h"
#include "swage/mesh_io.h"

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

void add_changes(Json& json, const Mesh& rest, const Gesture& gesture, const Positions& positions,
                 std::vector<std::string>& warnings) {
  auto number = [&](double value, const char* name) { return finite(value, name, warnings); };
  json["handle_error"] = number(largest_miss(gesture, positions) / box_diagonal(rest.positions), "handle_error");
  const Eigen::VectorXd turns = normal_turns(rest.positions, positions, rest.triangles);
  const Spread angle = spread(turns, area_vectors(rest.positions, rest.triangles).rowwise().norm());
  json["normal_error_deg"] = {{"mean", number(degrees(angle.mean), "normal_error_deg mean")},
                              {"percentile_95", number(degrees(angle.percentile_95), "normal_error_deg percentile_95")},
                              {"max", number(degrees(angle.max), "normal_error_deg max")}};
  json["flipped_triangles"] = flipped(turns);
  add_self_intersections(json, rest, positions, warnings);
}

Json finite(double value, const std::string& name, std::vector<std::string>& warnings) {
  if (std::isfinite(value)) return value;
  warnings.push_back(name + " is not finite");
  return nullptr;
}

Json run_json(const char* command, const std::string& input, const Mesh& mesh, const std::string& method) {
  return {{"command", command},
          {"version", SWAGE_VERSION},
          {"input", input},
          {"vertices", mesh.positions.rows()},
          {"triangles", mesh.triangles.rows()},
          {"components", component_count(mesh)},
          {"method", method}};
}

void add_backend(Json& json, const Backend& backend) {
  json["backend"] = backend.name();
  json["device"] = backend.device();
  json["precision"] = backend.precision() == Precision::single ? "single" : "double";
  json["threads"] = threads_in_use();
}

void add_costs(Json& json, const Report& report, const Backend& backend, const RunSeconds& seconds) {
  json["seconds"] = {{"read", seconds.read},
                     {"precompute", seconds.precompute},
                     {"solve", seconds.solve},
                     {"write", seconds.write},
                     {"total", seconds.total}};
  for (const auto& [stage, spent] : report.seconds) json["seconds_by_stage"][stage] = spent;
  for (const auto& [part, bytes] : report.bytes) json["memory_mb_by_part"][part] = 1e-6 * static_cast<double>(bytes);
  for (const auto& [choice, path] : report.paths) json["paths"][choice] = path;
  const Traffic traffic = backend.traffic();
  json["traffic"] = {{"uploaded_bytes", traffic.uploaded},
                     {"downloaded_bytes", traffic.downloaded},
                     {"build_seconds", traffic.build_seconds}};
  json["peak_memory_mb"] = peak_memory_mb();
}

void write_json(const std::string& path, const Json& json) {
  if (path.empty()) return;
  // Names of files and labels need not be UTF-8.
  const std::string text = json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  if (path == kStdout) return write_stdout(text);
  write_file(path, text);
}

}  // namespace swage::cli
