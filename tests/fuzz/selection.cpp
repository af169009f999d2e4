// Selections in words and, after an @, vertices in files.
#include <algorithm>

#include "fuzz.h"
#include "mesh_file.h"
#include "swage/handles.h"

namespace swage::fuzz {

void use(std::string_view bytes) {
  static const MeshFile mesh = pyramid();
  std::string text(bytes);
  if (bytes.starts_with('@')) {
    text = '@' + file_of(".txt", bytes.substr(1)).string();
  } else if (bytes.find('@') != std::string_view::npos) {
    return;  // No other files.
  }
  const auto selection = unless_refused<InvalidInput>([&] { return Selection(text); });
  if (!selection) return;
  const Eigen::Index count = mesh.mesh.positions.rows();
  const auto vertices = unless_refused<InvalidInput, UnreadableFile>([&] { return selection->vertices(mesh); });
  if (vertices) {
    require(!vertices->empty() && vertices->front() >= 0 && vertices->back() < count, "vertices are there");
    const auto not_after = [](int a, int b) { return a >= b; };
    require(std::adjacent_find(vertices->begin(), vertices->end(), not_after) == vertices->end(), "ascending");
  }
  const auto region = unless_refused<InvalidInput>([&] { return selection->region(mesh); });
  if (!region || !*region || !vertices) return;
  for (const int v : *vertices) {
    require((*region)->contains(mesh.mesh.positions.row(v).transpose()), "what is selected lies in the region");
  }
}

}  // namespace swage::fuzz
