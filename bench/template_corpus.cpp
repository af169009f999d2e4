// Templates fitted to every real mesh of their kinds: measures, and pictures beside the fitted surface.
//
//   template_corpus FOLDER [NAME...]   writes there template_corpus.json and a picture of each kind, of the meshes
//   whose
//                                      file's name contains one of those named, or of all.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "machine.h"
#include "measures.h"
#include "mesh_index.h"
#include "samples.h"
#include "swage/mesh_io.h"
#include "swage/render.h"
#include "swage/template_fit.h"

namespace swage::bench {
namespace {

using Json = nlohmann::ordered_json;

/// The template of a category of meshes.
const std::map<std::string, std::string>& kinds() {
  static const std::map<std::string, std::string> kKinds = {
      {"airplane", "airplane"}, {"bench", "couch"}, {"bottle", "vase"}, {"car", "car"},     {"chair", "chair"},
      {"lamp", "lamp"},         {"mug", "mug"},     {"sofa", "couch"},  {"table", "table"}, {"vase", "vase"}};
  return kKinds;
}

/// Those that the template of their category does not describe, and why.
const std::map<std::string, std::string>& strangers() {
  static const std::map<std::string, std::string> kStrangers = {
      {"bullet_racecar_chassis_diff", "a block of a chassis"},
      {"bullet_racecar_wheel", "a wheel"},
      {"bullet_table", "a cube"},
      {"bullet_table2", "a disc"},
      {"evo_wrc_wheel", "a wheel"},
      {"kaolin_armchair", "cushions on two bent frames"},
      {"kaolin_rocket", "a rocket with fins"},
      {"trimesh_chair_model", "a funnel on bent wire"},
  };
  return kStrangers;
}

struct Fitted {
  std::string name, kind;
  Json json;
  SheetRow row;
};

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// How far the fitted surface is from the mesh, root mean square, a part of D: what the template has and the mesh has
/// not.
double excess(const Mesh& surface, const Positions& mesh, const Triangles& triangles) {
  const UnitBox box = unit_box(mesh);
  const SurfaceDistance distance({box.into(mesh), triangles});
  const Positions points = box.into(surface_samples(surface, 2000, 1));
  double sum = 0;
  for (Eigen::Index p = 0; p < points.rows(); ++p) sum += std::pow(distance(points.row(p)).distance, 2);
  return std::sqrt(sum / static_cast<double>(points.rows())) * box.extent / box_diagonal(mesh);
}

Fitted fit(const test::ListedMesh& listed, const std::string& kind) {
  const Mesh mesh = read_mesh(listed.path).mesh;
  const Template of = shipped_template(kind);
  const double begin = cpu_seconds();
  const TemplateFit fit = fit_template(of, mesh.positions, mesh.triangles);
  const double seconds = cpu_seconds() - begin;
  Fitted fitted{listed.path.stem().string(), kind, {}, {}};
  std::vector<std::string> bounds;
  for (const int p : fit.at_bound) bounds.push_back(of.parameters()[static_cast<size_t>(p)].name);
  fitted.json = {{"mesh", listed.name},         {"template", kind},       {"rms", fit.residual},
                 {"largest", fit.largest},      {"cpu_seconds", seconds}, {"seconds", fit.report.seconds.at("solve")},
                 {"passes", fit.report.passes}, {"at_bound", bounds}};
  for (size_t p = 0; p < of.parameters().size(); ++p) {
    fitted.json["parameters"][of.parameters()[p].name] = fit.parameters[static_cast<Eigen::Index>(p)];
  }
  const Mesh surface = template_mesh(of, fit.parameters, {120, nullptr});
  const Positions turned = fit.pose.into(mesh.positions);
  const double more = excess(surface, turned, mesh.triangles);
  fitted.json["excess"] = more;
  const auto stranger = strangers().find(fitted.name);
  if (stranger != strangers().end()) fitted.json["stranger"] = stranger->second;
  std::printf("%-30s %-9s %6.2f %6.2f %6.2f %6.2f %5d  ", fitted.name.c_str(), kind.c_str(), 100 * fit.residual,
              100 * more, 100 * fit.largest, seconds / 2, fit.report.passes);
  for (const std::string& bound : bounds) std::printf(" %s", bound.c_str());
  std::printf("\n");
  std::fflush(stdout);

  char caption[64];
  std::snprintf(caption, sizeof caption, "rms %.2f %%, excess %.2f %%", 100 * fit.residual, 100 * more);
  // The picture shows the template's up upwards.
  fitted.row.title = fitted.name;
  fitted.row.view = automatic_view({turned, mesh.triangles});
  fitted.row.panels.push_back({{turned, mesh.triangles}, "", {}, {}, ""});
  fitted.row.panels.push_back({surface, "", {}, {}, caption});
  return fitted;
}

void write_sheets(const std::filesystem::path& folder, const std::vector<Fitted>& all) {
  if (!can_render()) return;
  std::map<std::string, std::vector<SheetRow>> sheets;
  for (const Fitted& one : all) sheets[one.kind].push_back(one.row);
  for (const auto& [kind, rows] : sheets) {
    RenderOptions options;
    options.width = 720;
    options.height = 260;
    options.supersampling = 2;
    const std::filesystem::path path = folder / (kind + ".png");
    write_png(path, contact_sheet(rows, {"mesh", "fitted template"}, options));
    std::printf("%s\n", path.string().c_str());
  }
}

bool is_asked(const std::string& name, const std::vector<std::string>& names) {
  return names.empty() || std::any_of(names.begin(), names.end(),
                                      [&](const std::string& part) { return name.find(part) != std::string::npos; });
}

void run(const std::filesystem::path& folder, const std::vector<std::string>& names) {
  std::filesystem::create_directories(folder);
  std::vector<Fitted> all;
  Json json = {{"context", {{"device", processor()}, {"threads", threads()}, {"commit", SWAGE_COMMIT}}},
               {"fits", Json::array()}};
  std::printf("%-30s %-9s %6s %6s %6s %6s %5s   %s\n", "mesh", "template", "rms", "excess", "most", "s", "steps",
              "at bounds");
  for (const test::ListedMesh& listed : test::listed_meshes()) {
    const auto kind = kinds().find(listed.columns.at("category"));
    if (kind == kinds().end() || !is_asked(listed.name, names)) continue;
    all.push_back(fit(listed, kind->second));
    json["fits"].push_back(all.back().json);
  }
  std::ofstream(folder / "template_corpus.json") << json.dump(1) << "\n";
  write_sheets(folder, all);
}

}  // namespace
}  // namespace swage::bench

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: template_corpus FOLDER [NAME...]\n");
    return 2;
  }
  try {
    swage::bench::run(argv[1], {argv + 2, argv + argc});
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "template_corpus: %s\n", error.what());
    return 1;
  }
}
