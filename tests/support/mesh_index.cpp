#include "mesh_index.h"

#include <fstream>

#include "places.h"

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
