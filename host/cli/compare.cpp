#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "compare_picture.h"
#include "failure.h"
#include "gesture_options.h"
#include "interrupt.h"
#include "options.h"
#include "progress_bar.h"
#include "report_json.h"
#include "straight.h"
#include "swage/compare.h"
#include "swage/error.h"

namespace swage::cli {
namespace {

struct CompareJob {
  std::string rest;
  std::vector<std::string> edits;
  std::string json, faces, straight = "auto", heat = "normals";
  double crease_angle = 145;
  StraightFinding finding;
  GestureOptions gesture;
  PictureOptions picture;
};

struct Measured {
  std::string path;
  Positions positions;
  std::vector<std::string> warnings;
  Comparison changes;
};

bool is_mesh_file(const std::filesystem::path& path) {
  try {
    format_of(path);
    return std::filesystem::is_regular_file(path);
  } catch (const InvalidInput&) {
    return false;
  }
}

/// Where a path is a folder, the mesh files in it, in order of their names, without the rest.
std::vector<std::string> files_of(const std::string& path, const std::string& rest) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (!fs::is_directory(path, error)) return {path};
  std::vector<std::string> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(path, error)) {
    std::error_code ignored;
    if (is_mesh_file(entry.path()) && !fs::equivalent(entry.path(), rest, ignored)) files.push_back(entry.path());
  }
  if (error) throw UnreadableFile(path + ": the folder cannot be read: " + error.message() + "; check its permissions");
  if (files.empty())
    throw UnreadableFile(path + ": there is no edit in this folder: no .obj .ply .stl .off file; name another");
  std::sort(files.begin(), files.end());
  return files;
}

void open_folders(CompareJob& job) {
  std::vector<std::string> edits;
  for (const std::string& path : job.edits) {
    const std::vector<std::string> files = files_of(path, job.rest);
    edits.insert(edits.end(), files.begin(), files.end());
  }
  job.edits = std::move(edits);
}

void check_job(const CompareJob& job) {
  check_finding(job.straight, job.finding);
  if (!job.json.empty()) check_can_be_written(job.json, "--json");
  check_different({{"--picture", job.picture.path}, {"--faces", job.faces}, {"--json", job.json}});
  check(job.picture);
  if (job.faces.empty()) return;
  if (job.edits.size() > 1) throw WrongUsage("--faces: one edit's numbers go into a file: name one edit");
  if (!job.faces.ends_with(".ply")) throw WrongUsage(fmt::format("--faces {}: name a .ply file", job.faces));
  check_can_be_written(job.faces, "--faces");
}

CompareOptions options_of(const CompareJob& job, const MeshFile& rest) {
  CompareOptions options;
  options.crease_angle = job.crease_angle * std::numbers::pi / 180;
  if (job.straight == "auto") {
    options.straight_chains = find_chains(rest.mesh, job.finding);
  } else if (job.straight != "none") {
    options.straight_chains = read_straight_chains(job.straight, static_cast<int>(rest.mesh.positions.rows()));
  }
  if (asks_for_handles(job.gesture)) options.gesture = GestureRecipe(job.gesture).on(rest);
  return options;
}

Measured measure(const Mesh& rest, const std::string& path, const CompareOptions& options,
                 const CommonOptions& common) {
  MeshFile edit = read_mesh(path);
  for (const std::string& warning : edit.warnings) spdlog::warn("{}", warning);
  if (edit.mesh.positions.rows() != rest.positions.rows()) {
    throw InvalidInput(fmt::format(
        "{}: it has {} vertices, but the rest has {}: an edit keeps their number and order; name edits of this rest",
        path, edit.mesh.positions.rows(), rest.positions.rows()));
  }
  ProgressBar bar(!common.quiet && !common.verbose);
  Comparison changes = compare(rest.positions, edit.mesh.positions, rest.triangles, options, [&](const Progress& now) {
    bar.show(now);
    return !interrupted();
  });
  stop_if_interrupted();
  return {path, std::move(edit.mesh.positions), std::move(edit.warnings), std::move(changes)};
}

Json spread_json(const Spread& spread, double factor = 1) {
  return {
      {"mean", factor * spread.mean}, {"percentile_95", factor * spread.percentile_95}, {"max", factor * spread.max}};
}

template <class T>
Json optional_json(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

std::optional<double> ratio(const std::optional<double>& after, const std::optional<double>& before) {
  if (!after || !before || *before == 0) return std::nullopt;
  return *after / *before;
}

Json round_json(const std::vector<RoundPart>& parts) {
  Json list = Json::array();
  for (const RoundPart& part : parts) {
    list.push_back({{"shape", part.is_sphere ? "sphere" : "cylinder or cone"},
                    {"first_triangle", part.first_triangle},
                    {"triangles", part.triangles},
                    {"area", part.area},
                    {"radius", part.radius},
                    {"out_of_round_before", part.before},
                    {"out_of_round_after", part.after}});
  }
  return list;
}

Json changes_json(const Measured& measured) {
  const Comparison& changes = measured.changes;
  const double degree = degrees(1);
  return {{"input", measured.path},
          {"normal_error_deg", spread_json(changes.turn, degree)},
          {"non_uniform_scale", spread_json(changes.uneven)},
          {"shear_deg", spread_json(changes.shear, degree)},
          {"size_change", spread_json(changes.size)},
          {"slippage_loss", spread_json(changes.slippage_loss)},
          {"slippage_measured", changes.slippage_measured},
          {"area_ratio", optional_json(ratio(changes.area_after, changes.area_before))},
          {"volume_ratio", optional_json(ratio(changes.volume_after, changes.volume_before))},
          {"out_of_round", optional_json(changes.out_of_round)},
          {"round_parts", round_json(changes.round_parts)},
          {"bend_before", optional_json(changes.bend_before)},
          {"bend_after", optional_json(changes.bend_after)},
          {"handle_error", optional_json(changes.handle_error)},
          {"flipped_triangles", changes.flipped},
          {"collapsed_triangles", changes.collapsed},
          {"self_intersections_before", optional_json(changes.crossings_before)},
          {"new_self_intersections", optional_json(changes.new_crossings)},
          {"warnings", measured.warnings}};
}

Json compare_json(const CompareJob& job, const MeshFile& rest, const std::vector<Measured>& edits) {
  Json json = {{"command", "compare"},
               {"version", SWAGE_VERSION},
               {"input", job.rest},
               {"vertices", rest.mesh.positions.rows()},
               {"triangles", rest.mesh.triangles.rows()},
               {"warnings", rest.warnings},
               {"edits", Json::array()}};
  for (const Measured& edit : edits) json["edits"].push_back(changes_json(edit));
  return json;
}

std::string percent(const std::optional<double>& value) { return value ? fmt::format("{:.3f}", 100 * *value) : "-"; }

std::string count(const std::optional<int>& value) { return value ? std::to_string(*value) : "-"; }

/// A line an edit.
void print(const std::vector<Measured>& edits) {
  size_t width = 4;
  for (const Measured& edit : edits) width = std::max(width, edit.path.size());
  std::string text = fmt::format("{:<{}}  {:>7} {:>7} {:>7}  {:>7} {:>7} {:>7} {:>8}  {:>7} {:>7} {:>7}  {:>5} {:>5}\n",
                                 "edit", width, "normals", "95 %", "most", "uneven", "shear", "size", "slippage",
                                 "round %", "bend %", "handle", "flips", "cross");
  for (const auto& [path, positions, warnings, c] : edits) {
    text += fmt::format(
        "{:<{}}  {:>7.2f} {:>7.2f} {:>7.2f}  {:>7.3f} {:>7.2f} {:>7.3f} {:>8.3f}  {:>7} {:>7} {:>7}  {:>5} {:>5}\n",
        path, width, degrees(c.turn.mean), degrees(c.turn.percentile_95), degrees(c.turn.max), c.uneven.mean,
        degrees(c.shear.mean), c.size.mean, c.slippage_loss.mean, percent(c.out_of_round), percent(c.bend_after),
        percent(c.handle_error), c.flipped, count(c.new_crossings));
  }
  write_stdout(text +
               "normals, shear: degrees; uneven, size: ln of stretches; slippage: of the map, a diagonal on; round: of "
               "radii; bend, handle: % of the diagonal; cross: new pairs\n");
}

void write_faces(const std::string& path, const Triangles& triangles, const Measured& edit) {
  if (path.empty()) return;
  const FaceChanges& faces = edit.changes.faces;
  write_face_values(path, {edit.positions, triangles},
                    {{"normal_error_deg", faces.turn * degrees(1)},
                     {"stretch_large", faces.stretches.col(0)},
                     {"stretch_small", faces.stretches.col(1)},
                     {"non_uniform_scale", faces.uneven},
                     {"shear_deg", faces.shear * degrees(1)},
                     {"size_change", faces.size},
                     {"slippage_loss", faces.slippage_loss}});
}

Image picture(const CompareJob& job, const Mesh& rest, const std::vector<Measured>& measured,
              const std::optional<Gesture>& gesture, const CommonOptions& common) {
  if (job.picture.path.empty()) return {};
  std::vector<PictureEdit> edits;
  edits.reserve(measured.size());
  for (const Measured& edit : measured) edits.push_back({edit.path, edit.positions, edit.changes});
  return picture_of(job.picture, job.heat, job.rest, rest, edits, gesture, common);
}

void run_compare(CompareJob job, const CommonOptions& common) {
  open_folders(job);
  check_job(job);
  apply(common);
  const MeshFile rest = read_mesh(job.rest);
  for (const std::string& warning : rest.warnings) spdlog::warn("{}", warning);
  const CompareOptions options = options_of(job, rest);
  std::vector<Measured> edits;
  for (const std::string& path : job.edits) edits.push_back(measure(rest.mesh, path, options, common));
  const Image image = picture(job, rest.mesh, edits, options.gesture, common);
  write_faces(job.faces, rest.mesh.triangles, edits.front());
  if (!job.picture.path.empty()) write_png(job.picture.path, image);
  write_json(job.json, compare_json(job, rest, edits));
  if (job.json != kStdout) print(edits);
}

}  // namespace

Command compare_command(CLI::App& program, const CommonOptions& common) {
  CLI::App* app = program.add_subcommand("compare", "Measures what edits of a mesh did to it");
  auto job = std::make_shared<CompareJob>();
  app->add_option("REST", job->rest, "The mesh before: .obj .ply .stl .off")->required();
  app->add_option("MESH", job->edits, "Edits of it, or folders of them: the same vertices in the same order")
      ->required();
  app->add_option("--json", job->json, "The measures as JSON; - for stdout, instead of the table")->type_name("FILE");
  app->add_option("--faces", job->faces, "The edit with the measures of each triangle as properties")
      ->type_name("FILE.ply");
  app->add_option("--crease-angle", job->crease_angle,
                  "Across edges of a smaller interior angle the surface is not smooth, degrees (145)")
      ->check(between(0, 180))
      ->type_name("DEG");
  CLI::Option* straight =
      app->add_option("--straight", job->straight, "Edges that were straight: auto finds them, none, or a file (auto)")
          ->type_name("auto|none|FILE");
  add_finding_options(*app, job->finding, *straight);
  add_gesture_options(*app, job->gesture);
  CLI::Option* picture =
      add_picture_option(*app, job->picture, "The rest and its edits side by side, with a heat map on the edits");
  add_heat_option(*app, job->heat, *picture);
  for (CLI::Option* option : add_view_options(*app, job->picture)) option->needs(picture);
  return {app, [job, &common] { run_compare(*job, common); }};
}

}  // namespace swage::cli
