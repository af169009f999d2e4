#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>
#include <numbers>

#include "facts.h"
#include "options.h"
#include "report_json.h"
#include "straight.h"
#include "swage/error.h"
#include "swage/mesh_io.h"
#include "swage/reshape.h"

namespace swage::cli {
namespace {

struct Verdict {
  bool solves = false;
  std::string words;
};

std::string needs(const Facts& facts) {
  std::string words = "reshape solves it directly";
  const int pieces = facts.components + facts.isolated_vertices;
  if (pieces > 1) words += fmt::format(", where each of its {} connected parts has a handle", pieces);
  return words;
}

/// Asks reshape itself: making one checks the mesh and does no more.
Verdict ask_reshape(const Mesh& mesh, const Facts& facts) {
  try {
    const Reshape checked(mesh.positions, mesh.triangles);
    return {true, needs(facts)};
  } catch (const InvalidInput& e) {
    return {false, std::string("reshape refuses it: ") + e.what()};
  }
}

int faces_with_repeats(const MeshFile& file) {
  int count = 0;
  for (std::vector<int> polygon : file.polygons) {
    std::sort(polygon.begin(), polygon.end());
    if (std::adjacent_find(polygon.begin(), polygon.end()) != polygon.end()) ++count;
  }
  return count;
}

void add_counts(Json& json, const Facts& facts) {
  json["vertices"] = facts.vertices;
  json["triangles"] = facts.triangles;
  json["components"] = facts.components;
  json["boundary_edges"] = facts.boundary_edges;
  json["boundary_loops"] = facts.boundary_loops;
  json["non_manifold_edges"] = facts.non_manifold_edges;
  json["non_manifold_vertices"] = facts.non_manifold_vertices;
  json["inconsistent_edges"] = facts.inconsistent_edges;
  json["degenerate_triangles"] = facts.degenerate_triangles;
  json["duplicate_triangles"] = facts.duplicate_triangles;
  json["duplicate_vertices"] = facts.duplicate_vertices;
  json["isolated_vertices"] = facts.isolated_vertices;
}

Json corner(const Eigen::Vector3d& point) { return {point[0], point[1], point[2]}; }

void add_measures(Json& json, const Facts& facts, std::vector<std::string>& warnings) {
  auto number = [&](double value, const char* name) { return finite(value, name, warnings); };
  json["edge_length"] = {{"mean", number(facts.mean_edge, "mean edge length")},
                         {"min_to_mean", number(facts.shortest_edge / facts.mean_edge, "shortest edge to mean")},
                         {"max_to_mean", number(facts.longest_edge / facts.mean_edge, "longest edge to mean")}};
  json["smallest_angle_deg"] = number(facts.smallest_angle * 180 / std::numbers::pi, "smallest angle");
  json["box"] = {corner(facts.low), corner(facts.high)};
  json["diagonal"] = (facts.high - facts.low).norm();
  json["volume"] = facts.volume ? number(*facts.volume, "volume") : Json(nullptr);
}

Json info_json(const std::string& path, const MeshFile& file, const Facts& facts, const Verdict& verdict) {
  std::vector<std::string> warnings = file.warnings;
  Json json = {{"command", "info"}, {"version", SWAGE_VERSION}, {"input", path}};
  add_counts(json, facts);
  add_measures(json, facts, warnings);
  json["reshape"] = {{"solves", verdict.solves}, {"words", verdict.words}};
  json["warnings"] = warnings;
  return json;
}

std::string volume_words(const Facts& facts) {
  if (!facts.volume) return "none: not closed and consistently oriented";
  return fmt::format("{:.6g}{}", *facts.volume, *facts.volume < 0 ? " (inside out: normals point inward)" : "");
}

void print(const std::string& path, const Facts& facts, const Verdict& verdict) {
  Json counts;
  add_counts(counts, facts);
  std::string text = path + "\n";
  for (const auto& [name, count] : counts.items()) {
    std::string words = name;
    std::replace(words.begin(), words.end(), '_', ' ');
    text += fmt::format("  {:<22} {}\n", words, count.get<int>());
  }
  text += fmt::format("  {:<22} {:.6g}, shortest {:.3g} and longest {:.3g} times that\n", "mean edge", facts.mean_edge,
                      facts.shortest_edge / facts.mean_edge, facts.longest_edge / facts.mean_edge);
  text += fmt::format("  {:<22} {:.3g} degrees\n", "smallest angle", facts.smallest_angle * 180 / std::numbers::pi);
  text += fmt::format("  {:<22} ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g}), diagonal {:.6g}\n", "box",
                      facts.low[0], facts.low[1], facts.low[2], facts.high[0], facts.high[1], facts.high[2],
                      (facts.high - facts.low).norm());
  text += fmt::format("  {:<22} {}\n{}\n", "volume", volume_words(facts), verdict.words);
  write_stdout(text);
}

void run_info(const std::string& path, const std::string& json_path, const ChainsOutput& chains,
              const CommonOptions& common) {
  if (!json_path.empty()) check_can_be_written(json_path, "--json");
  check(chains, json_path);
  apply(common);
  const MeshFile file = read_mesh(path);
  for (const std::string& warning : file.warnings) spdlog::warn("{}", warning);
  Facts facts = facts_of(file.mesh);
  // Reading drops the triangles of such faces; they are in the file all the same.
  facts.degenerate_triangles += faces_with_repeats(file);
  const Verdict verdict = ask_reshape(file.mesh, facts);
  write(chains, file.mesh);
  write_json(json_path, info_json(path, file, facts, verdict));
  if (json_path != kStdout) print(path, facts, verdict);
}

}  // namespace

Command info_command(CLI::App& program, const CommonOptions& common) {
  CLI::App* app = program.add_subcommand("info", "Tells what is wrong or special with a mesh");
  auto mesh = std::make_shared<std::string>();
  auto json = std::make_shared<std::string>();
  auto chains = std::make_shared<ChainsOutput>();
  app->add_option("MESH", *mesh, "The mesh: .obj .ply .stl .off")->required();
  app->add_option("--json", *json, "The facts as JSON; - for stdout, instead of the table")->type_name("FILE");
  CLI::Option* straight = app->add_option("--straight", chains->path, "Writes the straight chains found, one a line");
  add_finding_options(*app, chains->finding, *straight->type_name("FILE"));
  return {app, [mesh, json, chains, &common] { run_info(*mesh, *json, *chains, common); }};
}

}  // namespace swage::cli
