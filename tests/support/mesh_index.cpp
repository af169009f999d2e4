#include "mesh_index.h"

#include <array>
#include <fstream>

#include "places.h"
#include "swage/mesh_io.h"

namespace swage::test {
namespace {

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool is_quoted = false;
  for (const char c : line) {
    if (c == '"') is_quoted = !is_quoted;
    if (c == ',' && !is_quoted) {
      cells.emplace_back();
    } else if (c != '"') {
      cells.back() += c;
    }
  }
  return cells;
}

}  // namespace

Mesh ListedMesh::in_fans() const {
  const MeshFile file = read_mesh(path);
  std::vector<std::array<int, 3>> fans;
  for (const std::vector<int>& polygon : file.polygons) {
    for (size_t i = 2; i < polygon.size(); ++i) fans.push_back({polygon[0], polygon[i - 1], polygon[i]});
  }
  Mesh mesh{file.mesh.positions, Triangles(fans.size(), 3)};
  for (size_t t = 0; t < fans.size(); ++t) {
    mesh.triangles.row(static_cast<Eigen::Index>(t)) << fans[t][0], fans[t][1], fans[t][2];
  }
  return mesh;
}

std::vector<ListedMesh> listed_meshes() {
  std::vector<ListedMesh> meshes;
  if (!has_shared()) return meshes;
  std::ifstream lines(shared("data/meshes/index.csv"));
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> names = cells_of(line);
  while (std::getline(lines, line)) {
    const std::vector<std::string> cells = cells_of(line);
    ListedMesh mesh;
    for (size_t i = 0; i < cells.size(); ++i) mesh.columns[names.at(i)] = cells[i];
    if (mesh.columns["split"] != "dev" || mesh.letter() == 'X') continue;
    mesh.name = mesh.columns["file"].substr(std::string("dev/").size());
    mesh.path = shared("data/meshes") / mesh.name;
    if (std::filesystem::exists(mesh.path)) meshes.push_back(mesh);
  }
  return meshes;
}

}  // namespace swage::test
