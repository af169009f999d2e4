// Painted spheres and normals of meshes, PLY.
#include "fuzz.h"
#include "sphere_map.h"
#include "swage/style_io.h"

namespace swage::fuzz {

void use(std::string_view bytes) {
  const std::filesystem::path path = file_of(".ply", bytes);
  const auto mesh = unless_refused<UnreadableFile>([&] { return read_mesh(path); });
  const auto map = unless_refused<UnreadableFile, InvalidInput>([&] { return read_normal_capture(path); });
  require(!map || mesh, "a sphere is a mesh");
  if (map) require_sphere(*map);
  if (!mesh) return;
  const auto given = unless_refused<UnreadableFile, InvalidInput>([&] { return read_given_normals(path, *mesh); });
  if (!given) return;
  const Eigen::Index due = given->of_triangles ? mesh->mesh.triangles.rows() : mesh->mesh.positions.rows();
  require(given->normals.rows() == due && given->normals.allFinite(), "each vertex or triangle has its normal");
}

}  // namespace swage::fuzz
