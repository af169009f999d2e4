// The texture coordinates of an OBJ: vt, and the t of the corners v/t and v/t/n of faces.
#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "scanner.h"
#include "source.h"

namespace swage {
namespace {

/// Reads once more what read_obj() found to be in order: the faces that it found, and no others. A line that begins
/// with an f may be the rest of the line before.
class TextureReader {
 public:
  TextureReader(const Input& input, const std::vector<size_t>& face_offsets)
      : input_(input), face_offsets_(face_offsets), scan_(input, text_begin(input)) {}

  void read() {
    while (!scan_.at_end()) {
      if (!scan_.at_line_end()) statement();
      scan_.skip_line();
    }
    if (points.empty()) {
      refuse(input_, "has no texture coordinates (vt); unwrap the mesh and export it with them");
    }
    if (!missing_.empty()) refuse(input_, missing_offset_, missing_);
    check_indices();
  }

  std::vector<double> points;              // Two each.
  std::vector<std::vector<int>> polygons;  // Points of the corners.

 private:
  void statement() {
    const size_t offset = scan_.at();
    const std::string_view keyword = scan_.word();
    if (keyword == "vt") return point();
    if (polygons.size() < face_offsets_.size() && offset == face_offsets_[polygons.size()]) face(offset);
  }

  void point() {
    for (int k = 0; k < 2; ++k) {
      Slot slot;
      scan_.skip_blanks();
      points.push_back(scan_.number(slot, "a texture coordinate (there are two)"));
      require_coordinate(input_, slot.offset, points.back());
    }
  }

  void face(size_t offset) {
    std::vector<int> corners;
    bare_.clear();
    while (!scan_.at_line_end()) corners.push_back(corner());
    if (missing_.empty() && !bare_.empty()) {
      missing_ = "the corner " + bare_ + " of a face has no texture coordinates; unwrap all of the mesh";
      missing_offset_ = offset;
    }
    polygons.push_back(std::move(corners));
  }

  int corner() {
    const size_t begin = scan_.at();
    scan_.leading_integer("a vertex number");
    const bool has_point = scan_.take('/') && scan_.at_integer();
    const long long index = has_point ? scan_.leading_integer("a texture vertex number") : 0;
    if (scan_.take('/') && scan_.at_integer()) scan_.leading_integer("a normal number");
    if (!has_point) {
      if (bare_.empty()) bare_ = in_quotes(std::string_view(input_.bytes).substr(begin, scan_.at() - begin));
      return 0;
    }
    const auto count = static_cast<long long>(points.size() / 2);
    if (index == 0 || index < -count || index > std::numeric_limits<int>::max()) refuse_index(begin, index);
    return static_cast<int>(index > 0 ? index - 1 : count + index);
  }

  // They may follow the face that names them.
  void check_indices() const {
    const auto count = static_cast<int>(points.size() / 2);
    for (size_t p = 0; p < polygons.size(); ++p) {
      const int last = *std::max_element(polygons[p].begin(), polygons[p].end());
      if (last >= count) refuse_index(face_offsets_[p], last + 1LL);
    }
  }

  [[noreturn]] void refuse_index(size_t offset, long long index) const {
    refuse(input_, offset,
           "a face names texture coordinates " + std::to_string(index) + ", but the file has " +
               std::to_string(points.size() / 2) + "; mend the face or export the mesh again");
  }

  const Input& input_;
  const std::vector<size_t>& face_offsets_;
  Scanner scan_;
  std::string bare_;  // Of a face, a corner without.
  // The first such face, refused at the end: where there are none at all, the file is told of and not a line.
  std::string missing_;
  size_t missing_offset_ = 0;
};

}  // namespace

TextureCoordinates read_texture_coordinates(const MeshFile& file) {
  Input input{file.path, file.source ? file.source->bytes : std::string()};
  if (!file.source || file.source->format != MeshFormat::obj) {
    refuse(input, "texture coordinates are read from .obj files only; export the mesh as one");
  }
  if (input.bytes.find('\n') == std::string::npos) input.newline = '\r';
  TextureReader reader(input, file.source->face_offsets);
  reader.read();
  TextureCoordinates result;
  const auto count = static_cast<Eigen::Index>(reader.points.size() / 2);
  result.points = Eigen::Map<decltype(result.points)>(reader.points.data(), count, 2);
  result.triangles.resize(file.mesh.triangles.rows(), 3);
  for (Eigen::Index t = 0; t < result.triangles.rows(); ++t) {
    const auto p = static_cast<size_t>(file.triangle_polygons[static_cast<size_t>(t)]);
    const std::vector<int>& polygon = file.polygons[p];
    for (int k = 0; k < 3; ++k) {
      const auto at = std::find(polygon.begin(), polygon.end(), file.mesh.triangles(t, k)) - polygon.begin();
      result.triangles(t, k) = reader.polygons[p][static_cast<size_t>(at)];
    }
  }
  return result;
}

}  // namespace swage
