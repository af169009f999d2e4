#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>
#include <numbers>

#include "interrupt.h"
#include "options.h"
#include "progress_bar.h"
#include "report_json.h"
#include "shape_quality.h"
#include "straight.h"
#include "swage/diagnose.h"
#include "swage/error.h"
#include "swage/mesh_io.h"
#include "swage/reshape.h"

namespace swage::cli {
namespace {

struct Verdict {
  bool solves = false;
  std::string words;
};

std::string list(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : "; ") + part;
  return text;
}

/// What reshape does with such a mesh, in its order.
std::string plan_in_words(const Mesh& mesh, const Diagnosis& found) {
  std::vector<std::string> parts;
  const auto say = [&](int count, const char* what) {
    if (count > 0) parts.push_back(fmt::format("{} {}", count, what));
  };
  say(found.duplicate_vertices.count, "vertices at others' places move with them");
  say(found.duplicate_triangles.count, "repeated triangles are left out of the solve");
  say(found.inconsistent_edges.count,
      "edges between triangles that wind against each other: these are turned for the solve");
  say(found.degenerate_triangles.count, "triangles without area go with their neighbours");
  say(found.isolated_vertices.count, "vertices without a triangle go with the nearest surface");
  say(found.welded_components > 1 ? found.welded_components : 0,
      "components are held together where they touch or cross, else joined by a scaffold, or by links");
  const bool is_bad = badly_shaped(shape_quality(mesh.positions, mesh.triangles));
  parts.insert(parts.begin(), is_bad
                                  ? "reshape solves a remeshed stand-in and carries the edit back, since its triangles "
                                    "are needles, uneven or coarse (--remesh never: directly)"
                                  : "reshape solves it directly");
  return list(parts);
}

/// Asks reshape itself: making one checks the mesh and does no more.
Verdict ask_reshape(const Mesh& mesh, const Diagnosis& found) {
  try {
    const Reshape checked(mesh.positions, mesh.triangles);
    return {true, plan_in_words(mesh, found)};
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

Json counts(const Diagnosis& found) {
  return {{"vertices", found.vertices},
          {"triangles", found.triangles},
          {"components", found.components},
          {"welded_components", found.welded_components},
          {"boundary_edges", found.boundary_edges.count},
          {"boundary_loops", found.boundary_loops},
          {"non_manifold_edges", found.non_manifold_edges.count},
          {"non_manifold_vertices", found.non_manifold_vertices.count},
          {"inconsistent_edges", found.inconsistent_edges.count},
          {"degenerate_triangles", found.degenerate_triangles.count},
          {"duplicate_triangles", found.duplicate_triangles.count},
          {"duplicate_vertices", found.duplicate_vertices.count},
          {"isolated_vertices", found.isolated_vertices.count},
          {"self_intersections", found.self_intersections.count}};
}

/// Where the first of each is: a vertex, a triangle, an edge by its vertices or a pair of triangles.
Json firsts(const Diagnosis& found) {
  Json places = Json::object();
  const auto element = [&](const char* name, const FoundElements& one) {
    if (one.first >= 0) places[name] = one.first;
  };
  const auto pair = [&](const char* name, const FoundPairs& one) {
    if (one.count > 0) places[name] = one.first;
  };
  pair("boundary_edges", found.boundary_edges);
  pair("non_manifold_edges", found.non_manifold_edges);
  element("non_manifold_vertices", found.non_manifold_vertices);
  pair("inconsistent_edges", found.inconsistent_edges);
  element("degenerate_triangles", found.degenerate_triangles);
  element("duplicate_triangles", found.duplicate_triangles);
  element("duplicate_vertices", found.duplicate_vertices);
  element("isolated_vertices", found.isolated_vertices);
  pair("self_intersections", found.self_intersections);
  return places;
}

Json corner(const Eigen::Vector3d& point) { return {point[0], point[1], point[2]}; }

void add_measures(Json& json, const Diagnosis& found, std::vector<std::string>& warnings) {
  auto number = [&](double value, const char* name) { return finite(value, name, warnings); };
  json["edge_length"] = {{"mean", number(found.mean_edge, "mean edge length")},
                         {"min_to_mean", number(found.shortest_edge / found.mean_edge, "shortest edge to mean")},
                         {"max_to_mean", number(found.longest_edge / found.mean_edge, "longest edge to mean")}};
  json["smallest_angle_deg"] = number(degrees(found.smallest_angle), "smallest angle");
  json["low_angle_deg"] = number(degrees(found.low_angle), "low angle");
  json["needle_fraction"] = found.needle_fraction;
  json["box"] = {corner(found.low), corner(found.high)};
  json["diagonal"] = (found.high - found.low).norm();
  json["volume"] = found.volume ? number(*found.volume, "volume") : Json(nullptr);
}

Json info_json(const std::string& path, const MeshFile& file, const Diagnosis& found, const Verdict& verdict) {
  std::vector<std::string> warnings = file.warnings;
  Json json = {{"command", "info"}, {"version", SWAGE_VERSION}, {"input", path}};
  json.update(counts(found));
  json["self_intersections_complete"] = found.self_intersections_complete;
  json["first"] = firsts(found);
  add_measures(json, found, warnings);
  json["reshape"] = {{"solves", verdict.solves}, {"words", verdict.words}};
  json["warnings"] = warnings;
  return json;
}

std::string words_of(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string first_words(const Diagnosis& found) {
  const Json places = firsts(found);
  std::string text;
  for (const auto& [name, place] : places.items()) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", words_of(name),
                        place.is_array() ? fmt::format("{}-{}", place[0].get<int>(), place[1].get<int>())
                                         : std::to_string(place.get<int>()));
  }
  return text;
}

std::string volume_words(const Diagnosis& found) {
  if (!found.volume) return "none: not closed and consistently oriented";
  return fmt::format("{:.6g}{}", *found.volume, *found.volume < 0 ? " (inside out: normals point inward)" : "");
}

void print(const std::string& path, const Diagnosis& found, const Verdict& verdict) {
  std::string text = path + "\n";
  const auto row = [&text](const std::string& name, const std::string& words) {
    text += fmt::format("  {:<22} {}\n", name, words);
  };
  const Json numbers = counts(found);
  for (const auto& [name, count] : numbers.items()) row(words_of(name), std::to_string(count.get<int>()));
  if (!found.self_intersections_complete) row("", "or more self intersections: the search ended there");
  if (const std::string words = first_words(found); !words.empty()) row("first, counted from 0", words);
  row("mean edge", found.mean_edge == 0
                       ? "0"
                       : fmt::format("{:.6g}, shortest {:.3g} and longest {:.3g} times that", found.mean_edge,
                                     found.shortest_edge / found.mean_edge, found.longest_edge / found.mean_edge));
  row("smallest angle",
      fmt::format("{:.3g} degrees; {:.3g} at the 5th percentile; below 10 in {:.3g} % of triangles",
                  degrees(found.smallest_angle), degrees(found.low_angle), 100 * found.needle_fraction));
  row("box",
      fmt::format("({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g}), diagonal {:.6g}", found.low[0], found.low[1],
                  found.low[2], found.high[0], found.high[1], found.high[2], (found.high - found.low).norm()));
  row("volume", volume_words(found));
  write_stdout(text + verdict.words + "\n");
}

Diagnosis diagnose_file(const MeshFile& file, const CommonOptions& common) {
  ProgressBar bar(!common.quiet && !common.verbose);
  Diagnosis found = diagnose(file.mesh.positions, file.mesh.triangles, [&](const Progress& now) {
    bar.show(now);
    return !interrupted();
  });
  stop_if_interrupted();
  // Reading drops the triangles of such faces; they are in the file all the same.
  found.degenerate_triangles.count += faces_with_repeats(file);
  return found;
}

void run_info(const std::string& path, const std::string& json_path, const ChainsOutput& chains,
              const CommonOptions& common) {
  if (!json_path.empty()) check_can_be_written(json_path, "--json");
  check(chains, json_path);
  apply(common);
  const MeshFile file = read_mesh(path);
  for (const std::string& warning : file.warnings) spdlog::warn("{}", warning);
  const Diagnosis found = diagnose_file(file, common);
  const Verdict verdict = ask_reshape(file.mesh, found);
  write(chains, file.mesh);
  write_json(json_path, info_json(path, file, found, verdict));
  if (json_path != kStdout) print(path, found, verdict);
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
