// Templates fitted to every real mesh of their kinds, and three edits of each: measures, and pictures of the fitted
// surface and of the edits.
//
//   template_corpus FOLDER [NAME...]   writes there template_corpus.json and a picture of each kind; of the meshes
//                                      whose file's name contains one of those named, or of all
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "machine.h"
#include "mesh_index.h"
#include "swage/backend.h"
#include "swage/error.h"
#include "swage/mesh_io.h"
#include "swage/render.h"
#include "swage/template_edit.h"

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

/// One size by half as much again, another to 0.7, and an angle or the like.
struct Edit {
  std::string parameter;
  double factor, step;
};
const std::vector<Edit>& edits_of(const std::string& kind) {
  static const std::map<std::string, std::vector<Edit>> kEdits = {
      {"airplane", {{"span", 1.5, 0}, {"length", 0.7, 0}, {"sweep", 1, 0.3}}},
      {"car", {{"length", 1.5, 0}, {"height", 0.7, 0}, {"screen_lean", 1, 0.4}}},
      {"chair", {{"seat_height", 1.5, 0}, {"width", 0.7, 0}, {"back_lean", 1, 0.2}}},
      {"couch", {{"width", 1.5, 0}, {"depth", 0.7, 0}, {"back_lean", 1, 0.3}}},
      {"lamp", {{"height", 1.5, 0}, {"shade_bottom", 0.7, 0}, {"lean", 1, 0.2}}},
      {"mug", {{"height", 1.5, 0}, {"top", 0.7, 0}, {"handle_square", 1, 0.3}}},
      {"table", {{"width", 1.5, 0}, {"height", 0.7, 0}, {"leg_splay", 1, 0.15}}},
      {"vase", {{"height", 1.5, 0}, {"middle", 0.7, 0}, {"twist", 1, 60}}}};
  return kEdits.at(kind);
}

struct Fitted {
  std::string name, kind;
  Json json;
  SheetRow row;
};

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Each with its picture, where the template lies.
void edit(const Template& of, const TemplateFit& fit, const Mesh& mesh, Fitted& fitted) {
  TemplateEdit edit(of, fit.parameters, fit.pose, mesh.positions, mesh.triangles);
  for (const Edit& one : edits_of(fitted.kind)) {
    Eigen::VectorXd target = fit.parameters;
    double& value = target[of.parameter(one.parameter)];
    value = one.factor * value + one.step;
    const TemplateEditResult result = edit.solve(target);
    fitted.json["edits"].push_back({{"parameter", one.parameter},
                                    {"residual", result.residual},
                                    {"largest", result.largest},
                                    {"flipped", result.flipped},
                                    {"passes", result.report.passes},
                                    {"stop", to_string(result.report.stop)},
                                    {"paths", result.report.paths},
                                    {"seconds", result.report.seconds.at("solve")}});
    std::printf("    %-13s %7.3f %6.2f %5d flipped %5d passes (%s) %6.2f s\n", one.parameter.c_str(),
                100 * result.residual, 100 * result.largest, result.flipped, result.report.passes,
                to_string(result.report.stop), result.report.seconds.at("solve"));
    std::fflush(stdout);
    char caption[64];
    std::snprintf(caption, sizeof caption, "%s, %d flipped", one.parameter.c_str(), result.flipped);
    fitted.row.panels.push_back({{fit.pose.into(result.positions), mesh.triangles}, "", {}, {}, caption});
  }
}

/// What the program's `auto` comes to for fits.
std::shared_ptr<Backend> fitting_backend() {
  try {
    return opencl_backend();
  } catch (const Unavailable&) {
    return cpu_backend();
  }
}

Fitted fit(const test::ListedMesh& listed, const std::string& kind) {
  FitOptions options;
  options.backend = fitting_backend();
  const Mesh mesh = read_mesh(listed.path).mesh;
  const Template of = shipped_template(kind);
  const double begin = cpu_seconds();
  const TemplateFit fit = fit_template(of, mesh.positions, mesh.triangles, options);
  const double seconds = cpu_seconds() - begin;
  Fitted fitted{listed.path.stem().string(), kind, {}, {}};
  std::vector<std::string> bounds;
  for (const int p : fit.at_bound) bounds.push_back(of.parameters()[static_cast<size_t>(p)].name);
  fitted.json = {{"mesh", listed.name},         {"template", kind},
                 {"rms", fit.residual},         {"largest", fit.largest},
                 {"excess", fit.excess},        {"backend", options.backend->name()},
                 {"cpu_seconds", seconds},      {"seconds", fit.report.seconds.at("solve")},
                 {"passes", fit.report.passes}, {"at_bound", bounds}};
  for (size_t p = 0; p < of.parameters().size(); ++p) {
    fitted.json["parameters"][of.parameters()[p].name] = fit.parameters[static_cast<Eigen::Index>(p)];
  }
  const Mesh surface = template_mesh(of, fit.parameters, {120, nullptr});
  const Positions turned = fit.pose.into(mesh.positions);
  const auto stranger = strangers().find(fitted.name);
  if (stranger != strangers().end()) fitted.json["stranger"] = stranger->second;
  std::printf("%-30s %-9s %6.2f %6.2f %6.2f %6.2f %5d  ", fitted.name.c_str(), kind.c_str(), 100 * fit.residual,
              100 * fit.excess, 100 * fit.largest, fit.report.seconds.at("solve"), fit.report.passes);
  for (const std::string& bound : bounds) std::printf(" %s", bound.c_str());
  std::printf("\n");
  std::fflush(stdout);

  char caption[64];
  std::snprintf(caption, sizeof caption, "rms %.2f %%, excess %.2f %%", 100 * fit.residual, 100 * fit.excess);
  // The picture shows the template's up upwards.
  fitted.row.title = fitted.name;
  fitted.row.view = automatic_view({turned, mesh.triangles});
  fitted.row.panels.push_back({{turned, mesh.triangles}, "", {}, {}, ""});
  fitted.row.panels.push_back({surface, "", {}, {}, caption});
  edit(of, fit, mesh, fitted);
  return fitted;
}

void write_sheets(const std::filesystem::path& folder, const std::vector<Fitted>& all) {
  if (!can_render()) return;
  std::map<std::string, std::vector<SheetRow>> sheets;
  for (const Fitted& one : all) sheets[one.kind].push_back(one.row);
  for (const auto& [kind, rows] : sheets) {
    RenderOptions options;
    options.width = 1500;
    options.height = 260;
    options.supersampling = 2;
    const std::filesystem::path path = folder / (kind + ".png");
    write_png(path, contact_sheet(rows, {"mesh", "fitted template", "longer", "smaller", "turned"}, options));
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
