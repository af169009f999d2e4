// Normal maps, PNG.
#include "fuzz.h"
#include "mesh_file.h"
#include "png_file.h"
#include "swage/style_io.h"

namespace swage::fuzz {

void use(std::string_view bytes) {
  static const MeshFile mesh = pyramid();
  static const TextureCoordinates texture = read_texture_coordinates(mesh);
  if (takes_long(bytes, 1 << 20)) return;
  const auto map = unless_refused<UnreadableFile>([&] { return read_normal_picture(file_of(".png", bytes)); });
  if (!map) return;
  for (const NormalMapOptions& options : {NormalMapOptions{}, NormalMapOptions{NormalSpace::object, false}}) {
    const GivenNormals given = unbaked(mesh.mesh, texture, *map, options);
    for (const auto& normal : given.normals.rowwise()) {
      require(normal.isZero(0) || std::abs(normal.norm() - 1) < 1e-9, "normals are units, or none");
    }
  }
}

}  // namespace swage::fuzz
