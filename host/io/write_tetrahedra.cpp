#include <algorithm>
#include <cctype>
#include <string>

#include "number.h"
#include "swage/error.h"
#include "swage/mesh_io.h"
#include "swage/scaffold.h"

namespace swage {
namespace {

void append_points(std::string& out, const PositionsRef& positions, const char* end) {
  for (const auto& point : positions.rowwise()) {
    for (int k = 0; k < 3; ++k) {
      if (k > 0) out += ' ';
      append_number(out, NumberKind::text, point[k]);
    }
    out += end;
  }
}

std::string medit_text(const PositionsRef& positions, const TetrahedraRef& tetrahedra) {
  std::string out = "MeshVersionFormatted 2\nDimension 3\nVertices\n" + std::to_string(positions.rows()) + '\n';
  append_points(out, positions, " 0\n");
  out += "Tetrahedra\n" + std::to_string(tetrahedra.rows()) + '\n';
  for (const auto& corners : tetrahedra.rowwise()) {
    for (int corner : corners) {
      append_integer(out, corner + 1LL);
      out += ' ';
    }
    out += "0\n";
  }
  return out + "End\n";
}

std::string vtk_text(const PositionsRef& positions, const TetrahedraRef& tetrahedra) {
  const std::string count = std::to_string(tetrahedra.rows());
  std::string out = "# vtk DataFile Version 3.0\nWritten by Swage\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS " +
                    std::to_string(positions.rows()) + " double\n";
  append_points(out, positions, "\n");
  out += "CELLS " + count + ' ' + std::to_string(5 * tetrahedra.rows()) + '\n';
  for (const auto& corners : tetrahedra.rowwise()) {
    out += '4';
    for (int corner : corners) {
      out += ' ';
      append_integer(out, corner);
    }
    out += '\n';
  }
  out += "CELL_TYPES " + count + '\n';
  for (Eigen::Index t = 0; t < tetrahedra.rows(); ++t) out += "10\n";
  return out;
}

}  // namespace

void write_tetrahedra(const std::filesystem::path& path, const PositionsRef& positions,
                      const TetrahedraRef& tetrahedra) {
  for (Eigen::Index t = 0; t < tetrahedra.rows(); ++t) {
    if (tetrahedra.row(t).minCoeff() < 0 || tetrahedra.row(t).maxCoeff() >= positions.rows()) {
      throw InvalidInput("write_tetrahedra: tetrahedra: tetrahedron " + std::to_string(t) +
                         " names a vertex outside 0 to " + std::to_string(positions.rows() - 1) +
                         "; mend or remove it");
    }
  }
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  if (extension == ".mesh") return write_file(path, medit_text(positions, tetrahedra));
  if (extension == ".vtk") return write_file(path, vtk_text(positions, tetrahedra));
  throw InvalidInput("write_tetrahedra: path: " + path.string() + " is neither .mesh nor .vtk; use one of these");
}

}  // namespace swage
