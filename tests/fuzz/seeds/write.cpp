// Writes seeds that are binary or made from what the tests have: write_seeds FOLDER SHIPPED_TEMPLATES
#include <Eigen/Geometry>
#include <filesystem>
#include <numbers>

#include "fit_file.h"
#include "places.h"
#include "png_bytes.h"
#include "samples.h"
#include "swage/style.h"

namespace swage::test {
namespace {

namespace fs = std::filesystem;

class Seeds {
 public:
  explicit Seeds(fs::path folder) : folder_(std::move(folder)) {}

  void write(const std::string& target, const std::string& name, std::string_view bytes) const {
    fs::create_directories(folder_ / target);
    write_text(folder_ / target / name, bytes);
  }

 private:
  fs::path folder_;
};

void write_meshes(const Seeds& seeds) {
  for (const Sample& sample : samples()) {
    const std::string target = fs::path(sample.name).extension().string().substr(1);
    seeds.write(target == "STL" ? "stl" : target, sample.name, sample.bytes(moved_pyramid()));
  }
}

/// Every direction, latitudes by longitudes.
std::uint32_t on_globe(int column, int row) {
  const double down = std::numbers::pi * (row + 0.5) / 8, around = std::numbers::pi * (column + 0.5) / 8;
  return colour_of(-std::sin(down) * std::sin(around), std::cos(down), -std::sin(down) * std::cos(around));
}

void write_pictures(const Seeds& seeds) {
  const std::string two = {'\0', '\x80', '\x80', '\xff'};
  for (const char* const target : {"capture_png", "normal_map"}) {
    seeds.write(target, "globe.png", rgba_png(16, 8, on_globe));
    seeds.write(target, "straight.png", rgba_png(8, 4, [](int, int) { return colour_of(0, 0, 1); }));
    seeds.write(target, "deep.png", png_bytes({8, 4, 16, PngColours::rgb, {}}, std::string(192, '\xf0')));
    seeds.write(target, "palette.png",
                png_bytes({8, 4, 8, PngColours::palette, "\x80\x80\xff\xff\x80\x80"}, std::string(32, '\1')));
    seeds.write(target, "bits.png",
                png_bytes({8, 4, 1, PngColours::palette, "\x80\x80\xff\xff\x80\x80"}, std::string(4, '\x5a')));
    seeds.write(target, "grey.png", png_bytes({4, 2, 8, PngColours::grey, {}}, two + two));
  }
}

/// Of normals that are the directions themselves.
std::string sphere_ply(const Mesh& sphere) {
  std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(sphere.positions.rows()) +
                     "\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\nproperty float ny\n"
                     "property float nz\nelement face " +
                     std::to_string(sphere.triangles.rows()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const auto& p : sphere.positions.rowwise()) {
    for (int k = 0; k < 6; ++k) text += decimal(static_cast<float>(p[k % 3])) + (k < 5 ? " " : "\n");
  }
  for (const auto& t : sphere.triangles.rowwise()) {
    text += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) + "\n";
  }
  return text;
}

void write_spheres(const Seeds& seeds) {
  seeds.write("capture_ply", "octahedron.ply", sphere_ply(style_shape(StyleShape::octahedron)));
  seeds.write("capture_ply", "icosahedron.ply", sphere_ply(style_shape(StyleShape::icosahedron)));
}

void write_templates(const Seeds& seeds, const fs::path& shipped) {
  for (const auto& file : fs::directory_iterator(shipped)) {
    const std::string name = file.path().filename().string();
    seeds.write("template", name, read_text(file.path()));
    if (name != "box.json" && name != "mug.json") continue;
    const Template of = read_template(file.path());
    cli::Json json = {{"vertices", 8}, {"triangles", 12}};
    cli::add_fit(json, of.name(), of, of.defaults(), {2, Eigen::Matrix3d::Identity(), {0, 0.5, 0}});
    cli::add_document(json, of);
    seeds.write("fit", name, json.dump(1));
  }
}

}  // namespace
}  // namespace swage::test

int main(int /*count*/, char** words) {
  using namespace swage::test;
  const Seeds seeds(words[1]);
  write_meshes(seeds);
  write_pictures(seeds);
  write_spheres(seeds);
  write_templates(seeds, words[2]);
}
