// Models of our own making, resized: at rest, by plain scaling, and as resize() does it.
//
//   resize_pictures FOLDER [NAME...]   writes there resized.png, of those named or of all, and of each NAME.grid.png:
//   its
//                                      protective grid, before and after, coloured by vulnerability along the axis.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "resize_models.h"
#include "swage/render.h"
#include "swage/resize.h"

namespace swage::bench {
namespace {

struct Exhibit {
  std::string name;
  test::Assembled (*make)(double detail);
  double detail;
  Eigen::RowVector3d factors;
  Eigen::Vector3d eye;
  std::vector<std::string> protect = {};  ///< Parts.
};

const std::vector<Exhibit>& exhibits() {
  static const std::vector<Exhibit> kExhibits = {
      {"clock", test::clock_of_parts, 1.5, {1.8, 1, 1}, {0.35, 0.25, 1}},
      {"fan", test::fan, 1, {1, 1.5, 1}, {0.6, 0.2, 1}},
      {"car", test::car, 1.5, {2, 1, 1}, {-0.5, 0.45, 1}},
      {"fuel tank", test::tank, 1.5, {2, 1, 1}, {0.4, 0.5, 1}},
      {"lantern", test::lantern, 1.5, {1, 1.6, 1}, {0.3, 0.25, 1}},
      {"lantern, its rims protected", test::lantern, 1.5, {1, 1.6, 1}, {0.3, 0.25, 1}, {"upper rim", "lower rim"}},
  };
  return kExhibits;
}

std::string text_of(const Eigen::RowVector3d& factors) {
  char text[64];
  std::snprintf(text, sizeof text, "%g × %g × %g", factors[0], factors[1], factors[2]);
  return text;
}

std::vector<int> triangles_of(const test::Assembled& model, const std::vector<std::string>& parts) {
  std::vector<int> triangles;
  for (const std::string& name : parts) {
    for (const test::Part& part : model.named(name)) {
      for (int t = 0; t < model.mesh.triangles.rows(); ++t) {
        const int v = model.mesh.triangles(t, 0);
        if (v >= part.first && v < part.first + part.count) triangles.push_back(t);
      }
    }
  }
  return triangles;
}

Panel grid_panel(const GridShape& shape, const CellMap& map, const AxisValues& vertices, int axis) {
  Panel panel;
  std::vector<int> cells;
  panel.mesh = grid_surface(shape, map, vertices, &cells);
  panel.face_values.resize(static_cast<Eigen::Index>(cells.size()));
  for (size_t t = 0; t < cells.size(); ++t) panel.face_values[static_cast<Eigen::Index>(t)] = map.theta(cells[t], axis);
  return panel;
}

void write(const std::filesystem::path& path, const Image& image) {
  write_png(path, image);
  std::printf("%s\n", path.string().c_str());
}

/// Rest, plain scaling, ours.
SheetRow row_of(const Exhibit& exhibit, const std::filesystem::path& folder) {
  const test::Assembled model = exhibit.make(exhibit.detail);
  const Mesh& mesh = model.mesh;
  SheetRow row;
  row.title = exhibit.name + ", " + text_of(exhibit.factors);
  row.view = View{exhibit.eye, {0, 1, 0}};
  const auto add = [&](const Positions& positions) {
    // About their middles, as panels share a place of space.
    const Eigen::RowVector3d middle = (positions.colwise().minCoeff() + positions.colwise().maxCoeff()) / 2;
    row.panels.push_back({{positions.rowwise() - middle, mesh.triangles}, "", {}, {}, ""});
  };
  add(mesh.positions);
  add(mesh.positions * exhibit.factors.asDiagonal());
  Resize plan(mesh.positions, mesh.triangles);
  if (!exhibit.protect.empty()) {
    Protection protection;
    protection.triangles = triangles_of(model, exhibit.protect);
    plan.protect(protection);
  }
  const ResizeResult result = plan.solve({exhibit.factors});
  add(result.positions);
  int axis = 0;
  (exhibit.factors.array() - 1).abs().maxCoeff(&axis);
  RenderOptions options;
  options.view = row.view;
  options.heat_map = {0, 1, "vulnerability"};
  write(folder / (exhibit.name + ".grid.png"),
        render({grid_panel(plan.shape(), plan.map(), rest_vertices(plan.shape()), axis),
                grid_panel(plan.shape(), plan.map(), result.grid, axis)},
               options));
  return row;
}

void run(const std::filesystem::path& folder, const std::vector<std::string>& names) {
  std::filesystem::create_directories(folder);
  std::vector<SheetRow> rows;
  for (const Exhibit& exhibit : exhibits()) {
    if (names.empty() || std::find(names.begin(), names.end(), exhibit.name) != names.end()) {
      rows.push_back(row_of(exhibit, folder));
    }
  }
  RenderOptions options;
  options.width = 2600;
  options.height = 620;
  write(folder / "resized.png", contact_sheet(rows, {"rest", "plain scaling", "resize"}, options));
}

}  // namespace
}  // namespace swage::bench

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: resize_pictures FOLDER [NAME...]\n");
    return 2;
  }
  try {
    swage::bench::run(argv[1], {argv + 2, argv + argc});
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "resize_pictures: %s\n", error.what());
    return 1;
  }
}
