// The evidence: each gesture by slippage-preserving reshaping and by the methods it is judged against, measured and as
// pictures.
//
//   evidence FOLDER   writes there references.json and references.png, of the authors' models and gestures where the
//                     folder with them is, and furniture.png, of our own furniture.
//
// The slippage-preserving method and ALUP have the authors' curvatures and straight chains; all else is default.
// Slippage loss, uneven scale and the change of normals are compare()'s.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "furniture.h"
#include "machine.h"
#include "reference_models.h"
#include "swage/compare.h"
#include "swage/deform.h"
#include "swage/render.h"
#include "swage/reshape.h"
#include "table_lamp.h"

namespace swage::bench {
namespace {

using Json = nlohmann::ordered_json;

struct Method {
  std::string name;
  std::function<Positions(const Mesh&, const Gesture&, const ReshapeOptions&)> run;
};

Method reshaping(ReshapeMethod method) {
  return {to_string(method), [=](const Mesh& mesh, const Gesture& gesture, ReshapeOptions options) {
            options.method = method;
            return reshape(mesh.positions, mesh.triangles, gesture, options).positions;
          }};
}

Method deformation(DeformMethod method) {
  return {to_string(method), [=](const Mesh& mesh, const Gesture& gesture, const ReshapeOptions&) {
            DeformOptions options;
            options.method = method;
            return deform(mesh.positions, mesh.triangles, gesture, options).positions;
          }};
}

const std::vector<Method>& methods() {
  static const std::vector<Method> kMethods = {
      reshaping(ReshapeMethod::slippage), reshaping(ReshapeMethod::alup),         deformation(DeformMethod::poisson),
      deformation(DeformMethod::arap),    deformation(DeformMethod::arap_volume), deformation(DeformMethod::conformal)};
  return kMethods;
}

Json measures(const Comparison& changes) {
  const double degrees = 180 / std::numbers::pi;
  return {{"normals", degrees * changes.turn.mean},
          {"normals_95", degrees * changes.turn.percentile_95},
          {"slippage_loss", changes.slippage_loss.mean},
          {"uneven", changes.uneven.mean},
          {"size", changes.size.mean},
          {"handle_error", changes.handle_error.value_or(0)},
          {"flipped", changes.flipped}};
}

/// Solves and measures; the row of pictures is the rest with its handles, then each method's edit.
Json compare_methods(const Model& model, const Gesture& gesture, std::vector<SheetRow>& sheet) {
  const Mesh& mesh = model.mesh;
  SheetRow row;
  row.panels.push_back({mesh, "", handle_marks(gesture, mesh.positions, false), {}, model.name + " " + gesture.label});
  CompareOptions options;
  options.gesture = gesture;
  options.crossing_limit = 0;
  Json result = {{"model", model.name}, {"gesture", gesture.label}, {"triangles", mesh.triangles.rows()}};
  for (const Method& method : methods()) {
    const Positions edit = method.run(mesh, gesture, model.options);
    result["methods"][method.name] = measures(compare(mesh.positions, edit, mesh.triangles, options));
    const double normals = result["methods"][method.name]["normals"];
    char caption[32];
    std::snprintf(caption, sizeof caption, "normals %.1f°", normals);
    row.panels.push_back({{edit, mesh.triangles}, "", handle_marks(gesture, mesh.positions, true), {}, caption});
    std::printf("%s %s %s: %.2f degrees\n", model.name.c_str(), gesture.label.c_str(), method.name.c_str(), normals);
    std::fflush(stdout);
  }
  sheet.push_back(std::move(row));
  return result;
}

void write_sheet(const std::filesystem::path& path, const std::vector<SheetRow>& rows, int column, int height) {
  if (!can_render() || rows.empty()) return;
  std::vector<std::string> columns{"rest"};
  for (const Method& method : methods()) columns.push_back(method.name);
  RenderOptions options;
  options.width = column * static_cast<int>(columns.size());
  options.height = height;
  write_png(path, contact_sheet(rows, columns, options));
  std::printf("%s\n", path.string().c_str());
}

std::vector<Model> furniture() {
  Model chair{"chair", cli::chair(), {}, {}}, lamp{"lamp", table_lamp(), {}, {}};
  chair.gestures = {cli::wider_and_lower(chair.mesh)};
  lamp.gestures = {taller(lamp.mesh)};
  return {std::move(chair), std::move(lamp)};
}

void run(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::vector<SheetRow> own, references;
  for (const Model& model : furniture()) compare_methods(model, model.gestures.front(), own);
  write_sheet(folder / "furniture.png", own, 200, 240);

  Json json = {{"context", {{"device", processor()}, {"threads", threads()}, {"commit", SWAGE_COMMIT}}},
               {"gestures", Json::array()}};
  for (const std::string& name : reference_names()) {
    for (const Model& model : reference_model(name)) {
      for (const Gesture& gesture : model.gestures) {
        json["gestures"].push_back(compare_methods(model, gesture, references));
      }
    }
  }
  if (references.empty()) return;
  write_sheet(folder / "references.png", references, 280, 240);
  std::ofstream(folder / "references.json") << json.dump(1) << "\n";
}

}  // namespace
}  // namespace swage::bench

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: evidence FOLDER\n");
    return 2;
  }
  try {
    swage::bench::run(argv[1]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "evidence: %s\n", error.what());
    return 1;
  }
}
