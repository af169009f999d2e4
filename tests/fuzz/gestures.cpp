// Gestures, .deform files.
#include "swage/handles.h"

#include "fuzz.h"
#include "mesh_file.h"

namespace swage::fuzz {
namespace {

/// But for rounding.
void require_same(const Gesture& read, const Gesture& again, double diagonal) {
  require(read.label == again.label && read.targets.size() == again.targets.size(), "gestures are kept");
  for (const auto& [vertex, target] : read.targets) {
    const auto found = again.targets.find(vertex);
    require(found != again.targets.end(), "handles are kept");
    require((found->second - target).norm() <= 1e-14 * (target.norm() + diagonal), "targets are kept");
  }
}

}  // namespace

void use(std::string_view bytes) {
  static const MeshFile mesh = pyramid();
  const Positions& rest = mesh.mesh.positions;
  const auto read = [&](const std::filesystem::path& path) { return read_gestures(path, rest); };
  const auto gestures = unless_refused<UnreadableFile>([&] { return read(file_of(".deform", bytes)); });
  if (!gestures) return;
  const std::filesystem::path path = file_of(".deform", "");
  write_gestures(path, *gestures, rest);
  const std::vector<Gesture> again = read(path);
  require(again.size() == gestures->size(), "all gestures are kept");
  for (size_t g = 0; g < again.size(); ++g) {
    require_same((*gestures)[g], again[g], box_diagonal(rest));
    unless_refused<InvalidInput>([&] {
      check(again[g], rest, mesh.mesh.triangles);
      return true;
    });
  }
}

}  // namespace swage::fuzz
