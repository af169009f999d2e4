#include <algorithm>
#include <cctype>
#include <limits>
#include <ostream>

#include "source.h"
#include "swage/error.h"
#include "swage/mesh_io.h"
#include "triangulate.h"

namespace swage {
namespace {

/// What is written of a mesh that comes from no file, or from one of another format.
struct Content {
  const PositionsRef& positions;
  const Triangles& triangles;
  const std::vector<std::vector<int>>& polygons;  ///< None: the triangles are the faces.

  size_t face_count() const { return polygons.empty() ? static_cast<size_t>(triangles.rows()) : polygons.size(); }
  size_t corner_count(size_t face) const { return polygons.empty() ? 3 : polygons[face].size(); }
  int corner(size_t face, size_t k) const {
    if (!polygons.empty()) return polygons[face][k];
    return triangles(static_cast<Eigen::Index>(face), static_cast<Eigen::Index>(k));
  }
};

void append_point(std::string& out, const PositionsRef& positions, Eigen::Index v) {
  for (int k = 0; k < 3; ++k) {
    if (k > 0) out += ' ';
    append_number(out, NumberKind::text, positions(v, k));
  }
  out += '\n';
}

std::string obj_text(const Content& content) {
  std::string out = "# Written by Swage\n";
  for (Eigen::Index v = 0; v < content.positions.rows(); ++v) {
    out += "v ";
    append_point(out, content.positions, v);
  }
  for (size_t f = 0; f < content.face_count(); ++f) {
    out += 'f';
    for (size_t k = 0; k < content.corner_count(f); ++k) {
      out += ' ';
      append_integer(out, content.corner(f, k) + 1LL);
    }
    out += '\n';
  }
  return out;
}

std::string off_text(const Content& content) {
  std::string out =
      "OFF\n" + std::to_string(content.positions.rows()) + ' ' + std::to_string(content.face_count()) + " 0\n";
  for (Eigen::Index v = 0; v < content.positions.rows(); ++v) append_point(out, content.positions, v);
  for (size_t f = 0; f < content.face_count(); ++f) {
    append_integer(out, static_cast<long long>(content.corner_count(f)));
    for (size_t k = 0; k < content.corner_count(f); ++k) {
      out += ' ';
      append_integer(out, content.corner(f, k));
    }
    out += '\n';
  }
  return out;
}

void append_uint32(std::string& out, std::uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>((value >> shift) & 0xff);
}

std::string ply_bytes(const Content& content, const std::vector<FaceValues>& faces = {}) {
  size_t longest = 0;
  for (size_t f = 0; f < content.face_count(); ++f) longest = std::max(longest, content.corner_count(f));
  const bool is_short = longest <= std::numeric_limits<std::uint8_t>::max();
  std::string out = "ply\nformat binary_little_endian 1.0\ncomment Written by Swage\nelement vertex " +
                    std::to_string(content.positions.rows()) +
                    "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                    std::to_string(content.face_count()) + "\nproperty list " + (is_short ? "uchar" : "uint") +
                    " int vertex_indices\n";
  for (const FaceValues& face : faces) out += "property double " + face.name + "\n";
  out += "end_header\n";
  for (Eigen::Index v = 0; v < content.positions.rows(); ++v) {
    for (int k = 0; k < 3; ++k) append_number(out, NumberKind::f64_little, content.positions(v, k));
  }
  for (size_t f = 0; f < content.face_count(); ++f) {
    const auto count = static_cast<std::uint32_t>(content.corner_count(f));
    is_short ? out.push_back(static_cast<char>(count)) : append_uint32(out, count);
    for (size_t k = 0; k < count; ++k) append_uint32(out, static_cast<std::uint32_t>(content.corner(f, k)));
    for (const FaceValues& face : faces) {
      append_number(out, NumberKind::f64_little, face.values[static_cast<Eigen::Index>(f)]);
    }
  }
  return out;
}

std::string stl_bytes(const Content& content) {
  std::string out = "Written by Swage";
  out.resize(80, ' ');
  append_uint32(out, static_cast<std::uint32_t>(content.triangles.rows()));
  auto append = [&](const Eigen::Vector3d& vector) {
    for (const double x : vector) append_number(out, NumberKind::f32_little, x);
  };
  for (Eigen::Index t = 0; t < content.triangles.rows(); ++t) {
    const std::vector<int> corners = {content.triangles(t, 0), content.triangles(t, 1), content.triangles(t, 2)};
    append(area_vector(corners, content.positions).stableNormalized());
    for (const int v : corners) append(content.positions.row(v));
    out.append(2, '\0');
  }
  return out;
}

std::string fresh_bytes(MeshFormat format, const Content& content) {
  switch (format) {
    case MeshFormat::obj:
      return obj_text(content);
    case MeshFormat::ply:
      return ply_bytes(content);
    case MeshFormat::stl:
      return stl_bytes(content);
    case MeshFormat::off:
      break;
  }
  return off_text(content);
}

[[noreturn]] void refuse_polygon(size_t p, const std::string& why) {
  throw InvalidInput("write_mesh: file.polygons: polygon " + std::to_string(p) + " " + why);
}

void check_file(const MeshFile& file, const PositionsRef& positions) {
  check(positions, file.mesh.triangles);
  for (size_t p = 0; p < file.polygons.size(); ++p) {
    if (file.polygons[p].size() < 3) refuse_polygon(p, "has fewer than three corners; remove it");
    for (const int v : file.polygons[p]) {
      if (v < 0 || v >= positions.rows())
        refuse_polygon(p, "names vertex " + std::to_string(v) + ", which is not there; mend or remove it");
    }
  }
  const Eigen::Index expected = file.source ? file.source->vertex_count : file.mesh.positions.rows();
  if (positions.rows() != expected) {
    throw InvalidInput("write_mesh: positions: there are " + std::to_string(positions.rows()) +
                       " rows, but the file has " + std::to_string(expected) + " vertices; pass one row a vertex");
  }
  if (file.source && file.source->polygon_count != file.polygons.size()) {
    throw InvalidInput("write_mesh: file.polygons: they are not those of " + file.path.string() +
                       "; leave them as read");
  }
}

std::string mesh_bytes(MeshFormat format, const MeshFile& file, const PositionsRef& positions) {
  check_file(file, positions);
  if (file.source && file.source->format == format) return written_back(*file.source, file.polygons, positions);
  return fresh_bytes(format, {positions, file.mesh.triangles, file.polygons});
}

}  // namespace

void write_mesh(const std::filesystem::path& path, const MeshFile& file, const PositionsRef& positions) {
  write_file(path, mesh_bytes(format_of(path), file, positions));
}

void write_mesh(std::ostream& out, MeshFormat format, const MeshFile& file, const PositionsRef& positions) {
  const std::string bytes = mesh_bytes(format, file, positions);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size())).flush();
  if (!out) throw UnwritableFile("write_mesh: writing to the stream failed; is there room, and does a reader listen?");
}

void write_mesh(const std::filesystem::path& path, const Mesh& mesh) {
  check(mesh.positions, mesh.triangles);
  const std::vector<std::vector<int>> no_polygons;
  const PositionsRef positions = mesh.positions;
  write_file(path, fresh_bytes(format_of(path), {positions, mesh.triangles, no_polygons}));
}

void write_face_values(const std::filesystem::path& path, const Mesh& mesh, const std::vector<FaceValues>& faces) {
  check(mesh.positions, mesh.triangles);
  for (const FaceValues& face : faces) {
    const auto is_plain = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
    if (face.name.empty() || !std::all_of(face.name.begin(), face.name.end(), is_plain)) {
      throw InvalidInput("write_face_values: '" + face.name +
                         "' is no name of letters, digits and underscores; rename it");
    }
    if (face.values.size() == mesh.triangles.rows()) continue;
    throw InvalidInput("write_face_values: " + face.name + ": " + std::to_string(face.values.size()) + " values for " +
                       std::to_string(mesh.triangles.rows()) + " triangles; give one for each");
  }
  const std::vector<std::vector<int>> no_polygons;
  const PositionsRef positions = mesh.positions;
  write_file(path, ply_bytes({positions, mesh.triangles, no_polygons}, faces));
}

}  // namespace swage
