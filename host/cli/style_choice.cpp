#include "style_choice.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <optional>

#include "failure.h"
#include "swage/style_io.h"

namespace swage::cli {
namespace {

constexpr int kMostSides = 200;
// Of more directions the nearest is hardly another.
constexpr Eigen::Index kManyNormals = 100;

constexpr const char* kRoundedCube = "rounded-cube";

constexpr std::array<std::pair<const char*, StyleShape>, 5> kShapes{{{"tetrahedron", StyleShape::tetrahedron},
                                                                     {"cube", StyleShape::cube},
                                                                     {"octahedron", StyleShape::octahedron},
                                                                     {"dodecahedron", StyleShape::dodecahedron},
                                                                     {"icosahedron", StyleShape::icosahedron}}};

/// The number that follows `word`.
std::optional<int> sides_of(const std::string& name, const std::string& word) {
  if (!name.starts_with(word)) return std::nullopt;
  int sides = 0;
  const char *begin = name.data() + word.size(), *end = name.data() + name.size();
  const auto [at, error] = std::from_chars(begin, end, sides);
  if (at != end || error != std::errc() || sides < 3 || sides > kMostSides) return std::nullopt;
  return sides;
}

std::optional<Mesh> preset(const std::string& name) {
  for (const auto& [shape_name, shape] : kShapes) {
    if (name == shape_name) return style_shape(shape);
  }
  if (name == kRoundedCube) return rounded_cube();
  if (const auto sides = sides_of(name, "prism")) return prism(*sides);
  if (const auto sides = sides_of(name, "bipyramid")) return bipyramid(*sides);
  return std::nullopt;
}

bool is_mesh_name(const std::string& name) {
  try {
    format_of(name);
    return true;
  } catch (const InvalidInput&) {
    return false;
  }
}

std::string stem(const std::string& path) { return std::filesystem::path(path).stem().string(); }

ClosestNormals closest(const StylizeJob& job, std::vector<std::string>& warnings) {
  ClosestNormals style = naming("--style " + job.style, [&] {
    return closest_normals(job.style.empty() ? style_shape(StyleShape::cube) : style_mesh(job.style));
  });
  style.dynamic = !job.no_dynamic;
  if (style.normals.rows() > kManyNormals) {
    warnings.push_back(
        fmt::format("--style {}: its faces have {} directions, and nearly any normal is near one of them: --target "
                    "sphere follows the whole shape",
                    job.style, style.normals.rows()));
  }
  return style;
}

GivenNormals normal_map(const StylizeJob& job, const MeshFile& file) {
  const TextureCoordinates texture = read_texture_coordinates(file);
  NormalMapOptions options;
  options.space = job.normal_space == to_string(NormalSpace::object) ? NormalSpace::object : NormalSpace::tangent;
  options.green_down = job.green == "down";
  return unbaked(file.mesh, texture, read_normal_picture(job.normal_map), options);
}

CaptureLayout layout_of(const StylizeJob& job) {
  return job.layout == to_string(CaptureLayout::hemispheres) ? CaptureLayout::hemispheres
                                                             : CaptureLayout::equirectangular;
}

}  // namespace

std::string preset_names() {
  std::string names;
  for (const auto& [name, shape] : kShapes) names += std::string(name) + ", ";
  return names + "prism3, prism4 ..., bipyramid3, bipyramid4 ..., " + kRoundedCube;
}

void check_style_name(const std::string& name) {
  if (preset(name) || is_mesh_name(name)) return;
  throw WrongUsage(
      fmt::format("--style {}: give a mesh, .obj .ply .stl or .off, or a preset: {}", name, preset_names()));
}

Mesh style_mesh(const std::string& name) {
  if (std::optional<Mesh> shape = preset(name)) return *std::move(shape);
  return read_mesh(name).mesh;
}

std::string method_of(const StylizeJob& job) {
  if (job.polycube) return "polycube";
  if (job.developable) return "developable";
  if (!job.capture.empty()) return "capture";
  if (!job.normals.empty()) return "normals";
  if (!job.normal_map.empty()) return "normal-map";
  if (!job.target.empty()) return job.target;
  return job.style == kRoundedCube ? "sphere" : "closest";
}

std::string style_title(const StylizeJob& job) {
  if (job.developable) return "developable";
  for (const std::string* path : {&job.capture, &job.normals, &job.normal_map}) {
    if (!path->empty()) return stem(*path);
  }
  if (job.style.empty()) return "polycube";
  return is_mesh_name(job.style) ? stem(job.style) : job.style;
}

Style style_of(const StylizeJob& job, const MeshFile& file, std::vector<std::string>& warnings) {
  const std::string method = method_of(job);
  if (method == "developable") return Developable{job.tau.value_or(Developable{}.tau), job.threshold.value_or(0)};
  if (method == "capture") return read_normal_capture(job.capture, layout_of(job));
  if (method == "normals") return read_given_normals(job.normals, file);
  if (method == "normal-map") return normal_map(job, file);
  if (method == "sphere") {
    return naming("--style " + job.style, [&] { return sphere_map(style_mesh(job.style), job.published); });
  }
  return closest(job, warnings);
}

}  // namespace swage::cli
