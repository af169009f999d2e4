#include <algorithm>

#include "draft.h"
#include "swage/error.h"
#include "swage/mesh_io.h"

namespace swage {

MeshFormat format_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  if (extension == ".obj") return MeshFormat::obj;
  if (extension == ".ply") return MeshFormat::ply;
  if (extension == ".stl") return MeshFormat::stl;
  if (extension == ".off") return MeshFormat::off;
  throw InvalidInput("format_of: " + path.string() + ": extension " + in_quotes(extension) +
                     " names no mesh format; use .obj, .ply, .stl or .off");
}

MeshFile read_mesh(const std::filesystem::path& path) {
  const MeshFormat format = format_of(path);
  Input input = slurp(path);
  if (input.bytes.empty()) refuse(input, "is empty; export the mesh again");
  Draft draft;
  draft.source.format = format;
  switch (format) {
    case MeshFormat::obj:
      read_obj(input, draft);
      break;
    case MeshFormat::ply:
      read_ply(input, draft);
      break;
    case MeshFormat::stl:
      read_stl(input, draft);
      break;
    case MeshFormat::off:
      read_off(input, draft);
      break;
  }
  return finish(std::move(input), std::move(draft));
}

}  // namespace swage
