// OFF with its ST, C and N variants: a vertex or face a line, of which colours and texture coordinates pass unread.
#include "draft.h"
#include "scanner.h"

namespace swage {
namespace {

struct OffHeader {
  bool has_normals = false;
  long long vertex_count = 0, face_count = 0;
};

void refuse_binary(const Input& input) {
  const std::string_view line = std::string_view(input.bytes).substr(0, input.bytes.find(input.newline));
  if (line.find("OFF") == std::string_view::npos || line.find("BINARY") == std::string_view::npos) return;
  refuse(input, 0, "binary OFF is not read; convert it to ascii OFF or to PLY");
}

// The prefix of the keyword: whether it announces normals.
bool prefix_has_normals(const Input& input, size_t offset, std::string_view prefix) {
  auto take = [&](std::string_view part) {
    const bool found = prefix.starts_with(part);
    if (found) prefix.remove_prefix(part.size());
    return found;
  };
  take("ST");
  take("C");
  const bool has_normals = take("N");
  if (prefix == "4" || prefix == "n" || prefix == "4n") {
    refuse(input, offset, "OFF in four or n dimensions is not read; convert it to three");
  }
  if (!prefix.empty()) refuse(input, offset, "not an OFF file: its first word should be OFF; check its extension");
  return has_normals;
}

// The keyword may be missing, or run into the counts.
bool read_keyword(const Input& input, Scanner& scan) {
  const size_t begin = scan.at();
  const std::string_view word = scan.word();
  const size_t off = word.find("OFF");
  if (off != std::string_view::npos) {
    scan.jump(begin + off + 3);
    return prefix_has_normals(input, begin, word.substr(0, off));
  }
  scan.jump(begin);
  if (!scan.at_integer()) {
    refuse(input, begin, "not an OFF file: it begins with " + in_quotes(word) + " instead of OFF; check its extension");
  }
  return false;
}

OffHeader read_header(const Input& input, Scanner& scan) {
  OffHeader header;
  scan.skip_space_and_comments();
  header.has_normals = read_keyword(input, scan);
  scan.skip_space_and_comments();
  const size_t begin = scan.at();
  header.vertex_count = scan.integer("the number of vertices");
  scan.skip_blanks();
  header.face_count = scan.integer("the number of faces");
  scan.skip_line();
  // "0 0 0" is the shortest vertex, "0" the shortest face.
  require_room(input, begin, "vertices", header.vertex_count, 6, scan.remaining());
  require_room(input, begin, "faces", header.face_count, 2, scan.remaining());
  return header;
}

void read_vertex(const Input& input, Scanner& scan, Draft& draft, bool has_normal) {
  Slots slots;
  const size_t begin = scan.at();
  const Eigen::Vector3d position = scan.coordinates(slots);
  add_point(draft, add_vertex(input, draft, position, begin), slots);
  if (!has_normal) return;
  scan.normal(slots);
  draft.source.normals.push_back(slots);
}

void read_face(const Input& input, Scanner& scan, Draft& draft, std::vector<int>& corners) {
  const size_t begin = scan.at();
  const long long count = scan.integer("the number of a face's vertices");
  require_room(input, begin, "vertices of a face", count, 2, scan.remaining());
  corners.clear();
  for (long long k = 0; k < count; ++k) {
    scan.skip_blanks();
    const size_t offset = scan.at();
    corners.push_back(checked_index(input, offset, scan.integer("a vertex of a face"), draft.vertex_count()));
  }
  add_polygon(input, draft, corners, begin);
}

}  // namespace

void read_off(Input& input, Draft& draft) {
  refuse_binary(input);
  require_text(input);
  Scanner scan(input, text_begin(input));
  const OffHeader header = read_header(input, scan);
  for (long long v = 0; v < header.vertex_count; ++v) {
    scan.skip_space_and_comments();
    read_vertex(input, scan, draft, header.has_normals);
    scan.skip_line();
  }
  std::vector<int> corners;
  for (long long f = 0; f < header.face_count; ++f) {
    scan.skip_space_and_comments();
    read_face(input, scan, draft, corners);
    scan.skip_line();
  }
  if (header.has_normals) use_vertex_normals(draft);
}

}  // namespace swage
