// Models of our own making at rest, plainly scaled and resized, as pictures.
//
//   resize_pictures FOLDER [NAME...]   writes there resized.png, of those named or of all.
#include <algorithm>
#include <array>
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
  std::string name, how;
  test::Assembled (*make)();
  ResizeTarget target;
  Eigen::Vector3d eye;
  std::vector<std::string> protect = {}, release = {};  ///< Parts; released along y.
};

template <test::Assembled (*kMake)(double)>
test::Assembled fine() {
  return kMake(1.5);
}

ResizeTarget by(double x, double y, ResizeKeep keep = ResizeKeep::shape) {
  ResizeTarget target;
  target.factors << x, y, 1;
  target.keep = keep;
  return target;
}

const std::vector<Exhibit>& exhibits() {
  static const std::vector<Exhibit> kExhibits = {
      {"clock", "1.8 times as wide", fine<test::clock_of_parts>, by(1.8, 1), {0.35, 0.25, 1}},
      {"fan", "1.5 times as high", fine<test::fan>, by(1, 1.5), {0.6, 0.2, 1}},
      {"car", "twice as long", fine<test::car>, by(2, 1), {-0.5, 0.45, 1}},
      {"fuel tank", "twice as long", fine<test::tank>, by(2, 1), {0.4, 0.5, 1}},
      {"plate",
       "twice as long, sizes kept",
       [] { return test::bolted_plate(true); },
       by(2, 1, ResizeKeep::size),
       {0.3, 0.8, 0.7}},
      {"lantern", "1.6 times as high", fine<test::lantern>, by(1, 1.6), {0.3, 0.25, 1}},
      {"lantern",
       "the same; the user protects its rims and releases its paper",
       fine<test::lantern>,
       by(1, 1.6),
       {0.3, 0.25, 1},
       {"upper rim", "lower rim"},
       {"paper"}},
  };
  return kExhibits;
}

std::vector<int> triangles_of(const test::Assembled& model, const std::string& name) {
  std::vector<int> triangles;
  for (const test::Part& part : model.named(name)) {
    for (int t = 0; t < model.mesh.triangles.rows(); ++t) {
      const int v = model.mesh.triangles(t, 0);
      if (v >= part.first && v < part.first + part.count) triangles.push_back(t);
    }
  }
  return triangles;
}

SheetRow row_of(const Exhibit& exhibit) {
  const test::Assembled model = exhibit.make();
  const Mesh& mesh = model.mesh;
  SheetRow row;
  row.title = exhibit.name + ", " + exhibit.how;
  row.view = View{exhibit.eye, {0, 1, 0}};
  const auto add = [&](const Positions& positions) {
    // About their middles: panels share a place of space.
    const Eigen::RowVector3d middle = (positions.colwise().minCoeff() + positions.colwise().maxCoeff()) / 2;
    row.panels.push_back({{positions.rowwise() - middle, mesh.triangles}, "", {}, {}, ""});
  };
  add(mesh.positions);
  add(mesh.positions * exhibit.target.factors.asDiagonal());
  Resize plan(mesh.positions, mesh.triangles);
  const auto lay = [&](const std::vector<std::string>& parts, double value, const std::array<bool, 3>& axes) {
    for (const std::string& name : parts) {
      Protection protection;
      protection.triangles = triangles_of(model, name);
      protection.value = value;
      protection.axes = axes;
      plan.protect(protection);
    }
  };
  lay(exhibit.release, 0, {false, true, false});
  lay(exhibit.protect, 1, {true, true, true});
  add(plan.solve(exhibit.target).positions);
  return row;
}

void run(const std::filesystem::path& folder, const std::vector<std::string>& names) {
  std::filesystem::create_directories(folder);
  std::vector<SheetRow> rows;
  for (const Exhibit& exhibit : exhibits()) {
    if (names.empty() || std::find(names.begin(), names.end(), exhibit.name) != names.end()) {
      rows.push_back(row_of(exhibit));
    }
  }
  RenderOptions options;
  options.width = 1200;
  options.height = 256;
  const std::filesystem::path path = folder / "resized.png";
  write_png(path, contact_sheet(rows, {"rest", "plain scaling", "resize"}, options));
  std::printf("%s\n", path.string().c_str());
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
