// OBJ files, and their texture coordinates.
#include "fuzz.h"
#include "mesh_file.h"

namespace swage::fuzz {

void use(std::string_view bytes) {
  const std::optional<MeshFile> file = use_mesh(".obj", bytes);
  if (!file) return;
  const auto texture = unless_refused<UnreadableFile>([&] { return read_texture_coordinates(*file); });
  if (!texture) return;
  require(texture->triangles.rows() == file->mesh.triangles.rows(), "each triangle lies in the picture");
  require(texture->triangles.minCoeff() >= 0 && texture->triangles.maxCoeff() < texture->points.rows(),
          "its corners are points there");
  require(texture->points.allFinite(), "which are finite");
}

}  // namespace swage::fuzz
