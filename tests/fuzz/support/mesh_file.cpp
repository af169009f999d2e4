#include "mesh_file.h"

#include <algorithm>
#include <sstream>

#include "fuzz.h"

namespace swage::fuzz {
namespace {

bool are_vertices(const std::vector<int>& indices, const Mesh& mesh) {
  return std::all_of(indices.begin(), indices.end(), [&](int v) { return v >= 0 && v < mesh.positions.rows(); });
}

void check_parts(const MeshFile& file) {
  check(file.mesh.positions, file.mesh.triangles);
  for (const std::vector<int>& polygon : file.polygons) {
    require(polygon.size() >= 3 && are_vertices(polygon, file.mesh), "polygons have corners that are there");
  }
  require(file.triangle_polygons.size() == static_cast<size_t>(file.mesh.triangles.rows()), "triangles have polygons");
  for (size_t t = 0; t < file.triangle_polygons.size(); ++t) {
    const auto p = static_cast<size_t>(file.triangle_polygons[t]);
    require(p < file.polygons.size(), "a triangle's polygon is there");
    for (const int v : file.mesh.triangles.row(static_cast<Eigen::Index>(t))) {
      require(std::find(file.polygons[p].begin(), file.polygons[p].end(), v) != file.polygons[p].end(),
              "a triangle is a part of its polygon");
    }
  }
  for (const auto& [name, vertices] : file.groups) {
    require(are_vertices(vertices, file.mesh) && std::is_sorted(vertices.begin(), vertices.end()),
            "groups hold vertices in order");
  }
}

std::string written(const MeshFile& file, MeshFormat format, const PositionsRef& positions) {
  std::ostringstream out;
  write_mesh(out, format, file, positions);
  return out.str();
}

/// Into its own format. A point reflection is exact in all number formats and keeps which corners are equal, so that
/// the same mesh is read again.
void write_back(const std::string& extension, const MeshFile& file, std::string_view bytes) {
  const MeshFormat format = format_of(file.path);
  require(written(file, format, file.mesh.positions) == bytes, "a mesh that did not move gives the same bytes");
  const Positions reflected = -file.mesh.positions;
  const MeshFile again = read_mesh(file_of(extension, written(file, format, reflected)));
  require(again.mesh.positions == reflected, "positions written back are read again");
  require(again.polygons == file.polygons && again.mesh.triangles == file.mesh.triangles, "faces are kept");
}

void write_elsewhere(const MeshFile& file) {
  // Normals turn; what STL rounds to single precision may lose its triangles.
  const Positions turned = file.mesh.positions.rowwise().reverse();
  for (const char* const extension : {".obj", ".ply", ".off", ".stl"}) {
    const MeshFormat format = format_of("fuzzed" + std::string(extension));
    const std::string bytes = written(file, format, turned);
    const std::filesystem::path path = file_of(extension, bytes);
    if (format == MeshFormat::stl) {
      unless_refused<UnreadableFile>([&] { return read_mesh(path); });
      continue;
    }
    const MeshFile again = read_mesh(path);
    require(again.polygons == file.polygons, "polygons are the same in another format");
    const bool is_exact = format != format_of(file.path);
    require(!is_exact || again.mesh.positions == turned, "positions are the same in another format");
  }
}

}  // namespace

std::optional<MeshFile> use_mesh(const std::string& extension, std::string_view bytes) {
  std::optional<MeshFile> file = unless_refused<UnreadableFile>([&] { return read_mesh(file_of(extension, bytes)); });
  if (!file) return file;
  check_parts(*file);
  write_back(extension, *file, bytes);
  write_elsewhere(*file);
  return file;
}

MeshFile pyramid() {
  return read_mesh(file_of(".obj",
                           "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 1 1.5\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 0.5 0.5\n"
                           "g base\nf 1/1 4/4 3/3 2/2\ng sides\nf 1/1 2/2 5/5\nf 2/2 3/3 5/5\nf 3/3 4/4 5/5\n"
                           "f 4/4 1/1 5/5\n"));
}

}  // namespace swage::fuzz
