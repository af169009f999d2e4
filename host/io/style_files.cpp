// Captures and given normals from files.
#include <algorithm>
#include <string>
#include <utility>

#include "ply_normals.h"
#include "source.h"
#include "swage/error.h"
#include "swage/style_io.h"

namespace swage {
namespace {

std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return extension;
}

/// What a file holds may be refused where it is used: the file is named then.
template <typename Make>
SphereMap made_of(const std::filesystem::path& path, const Make& make) {
  try {
    return make();
  } catch (const InvalidInput& refused) {
    throw InvalidInput(path.string() + ": " + refused.what());
  }
}

Positions vertex_normals(const MeshFile& file) {
  Input input{file.path, file.source->bytes};
  PlyNormals normals = read_ply_normals(input);
  if (normals.vertices.rows() > 0) return std::move(normals.vertices);
  refuse(input, "its vertices have no normals, properties nx, ny and nz of type float or double; export it with them");
}

void check_finite(const Input& input, const Positions& normals, const char* what) {
  for (Eigen::Index i = 0; i < normals.rows(); ++i) {
    if (normals.row(i).allFinite()) continue;
    refuse(input, "the normal of " + std::string(what) + " " + std::to_string(i) + " is not finite; mend it");
  }
}

[[noreturn]] void refuse_count(const std::filesystem::path& path, Eigen::Index count, const char* what,
                               Eigen::Index due) {
  throw InvalidInput(path.string() + ": it has normals of " + std::to_string(count) + " " + what +
                     ", but the mesh has " + std::to_string(due) + ": give those of the mesh itself");
}

}  // namespace

SphereMap read_normal_capture(const std::filesystem::path& path, CaptureLayout layout) {
  const std::string extension = extension_of(path);
  if (extension == ".png") {
    const NormalPicture picture = read_normal_picture(path);
    return made_of(path, [&] { return normal_capture(picture, layout); });
  }
  if (extension != ".ply") {
    throw InvalidInput("read_normal_capture: " + path.string() +
                       ": a capture is a picture, .png, or a sphere whose vertices have normals, .ply");
  }
  const MeshFile sphere = read_mesh(path);
  const Positions normals = vertex_normals(sphere);
  return made_of(path, [&] { return normal_capture(sphere.mesh, normals); });
}

GivenNormals read_given_normals(const std::filesystem::path& path, const MeshFile& mesh) {
  if (extension_of(path) != ".ply") {
    throw InvalidInput("read_given_normals: " + path.string() + ": normals are read from .ply files: export one");
  }
  Input input = slurp(path);
  PlyNormals normals = read_ply_normals(input);
  if (normals.vertices.rows() > 0) {
    const Eigen::Index due = mesh.mesh.positions.rows();
    if (normals.vertices.rows() != due) refuse_count(path, normals.vertices.rows(), "vertices", due);
    check_finite(input, normals.vertices, "vertex");
    return {std::move(normals.vertices), false};
  }
  if (normals.faces.rows() == 0) {
    refuse(input,
           "neither its vertices nor its faces have normals, properties nx, ny and nz of type float or double; "
           "export it with them");
  }
  const auto due = static_cast<Eigen::Index>(mesh.polygons.size());
  if (normals.faces.rows() != due) refuse_count(path, normals.faces.rows(), "faces", due);
  check_finite(input, normals.faces, "face");
  return {Positions(normals.faces(mesh.triangle_polygons, Eigen::all)), true};
}

}  // namespace swage
