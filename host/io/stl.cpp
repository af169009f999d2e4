// STL, ascii and binary. Corners with equal coordinates become one vertex.
#include <unordered_map>

#include "draft.h"
#include "scanner.h"

namespace swage {
namespace {

constexpr size_t kHeaderSize = 84;  // 80 bytes of anything and the number of triangles.
constexpr size_t kTriangleSize = 50;

struct CoordinateHash {
  size_t operator()(const std::array<double, 3>& point) const {
    size_t seed = 0;
    for (const double x : point) seed = (seed ^ std::hash<double>()(x)) * 0x9e3779b97f4a7c15u + (seed >> 29);
    return seed;
  }
};

class Welder {
 public:
  Welder(const Input& input, Draft& draft) : input_(input), draft_(draft) {}

  int corner(const Eigen::Vector3d& position, const Slots& slots) {
    // Both zeros are equal and have one hash.
    const auto [found, is_new] = vertices_.try_emplace({position.x(), position.y(), position.z()}, 0);
    if (is_new) found->second = add_vertex(input_, draft_, position, slots[0].offset);
    add_point(draft_, found->second, slots);
    return found->second;
  }

  void facet(const std::vector<int>& corners, const Slots& normal, size_t offset) {
    const int polygon = static_cast<int>(draft_.polygons.size());
    add_polygon(input_, draft_, corners, offset);
    draft_.normal_users.emplace_back(static_cast<int>(draft_.source.normals.size()), polygon);
    draft_.source.normals.push_back(normal);
  }

 private:
  const Input& input_;
  Draft& draft_;
  std::unordered_map<std::array<double, 3>, int, CoordinateHash> vertices_;
};

bool same_word(std::string_view found, std::string_view word) {
  return found.size() == word.size() &&
         std::equal(found.begin(), found.end(), word.begin(), [](char a, char b) { return (a | 0x20) == b; });
}

class AsciiStl {
 public:
  AsciiStl(const Input& input, Draft& draft) : input_(input), scan_(input, text_begin(input)), weld_(input, draft) {}

  void read() {
    for (scan_.skip_space(); !scan_.at_end(); scan_.skip_space()) {
      const size_t begin = scan_.at();
      const std::string_view word = scan_.word();
      if (same_word(word, "solid")) {
        open_ = true;
        scan_.skip_line();
      } else if (same_word(word, "endsolid")) {
        open_ = false;
        scan_.skip_line();
      } else if (same_word(word, "facet")) {
        facet(begin);
      } else {
        refuse(input_, begin, in_quotes(word) + " where a facet or endsolid is expected; export the mesh again");
      }
    }
    if (open_) refuse(input_, scan_.at(), "the file ends without endsolid; it is truncated: export it again");
  }

 private:
  void facet(size_t begin) {
    Slots normal;
    expect("normal");
    triple(normal, "a number of a facet's normal");
    expect("outer");
    expect("loop");
    corners_.clear();
    for (int k = 0; k < 3; ++k) vertex();
    expect("endloop");
    expect("endfacet");
    weld_.facet(corners_, normal, begin);
  }

  void vertex() {
    expect("vertex");
    Slots slots;
    const Eigen::Vector3d position = triple(slots, "a coordinate");
    for (size_t k = 0; k < 3; ++k) require_coordinate(input_, slots[k].offset, position[static_cast<int>(k)]);
    corners_.push_back(weld_.corner(position, slots));
  }

  Eigen::Vector3d triple(Slots& slots, const char* what) {
    Eigen::Vector3d values;
    for (int k = 0; k < 3; ++k) {
      scan_.skip_space();
      values[k] = scan_.number(slots[static_cast<size_t>(k)], what);
    }
    return values;
  }

  void expect(const char* word) {
    scan_.skip_space();
    const size_t begin = scan_.at();
    const std::string_view found = scan_.word();
    if (same_word(found, word)) return;
    const std::string expected = std::string(word) + " is expected in a facet";
    if (found.empty()) refuse(input_, begin, "the file ends where " + expected + "; it is truncated: export it again");
    refuse(input_, begin, expected + ", not " + in_quotes(found) + "; facets are triangles: export the mesh again");
  }

  const Input& input_;
  Scanner scan_;
  Welder weld_;
  std::vector<int> corners_;
  bool open_ = false;
};

Slots floats_at(size_t offset) {
  Slots slots;
  for (size_t k = 0; k < 3; ++k) slots[k] = {offset + 4 * k, 4, NumberKind::f32_little};
  return slots;
}

void read_binary_facet(const Input& input, Welder& weld, size_t offset, std::vector<int>& corners) {
  corners.clear();
  for (size_t k = 0; k < 3; ++k) {
    const Slots slots = floats_at(offset + 12 * (k + 1));
    Eigen::Vector3d position;
    for (int axis = 0; axis < 3; ++axis) {
      const Slot& slot = slots[static_cast<size_t>(axis)];
      position[axis] = read_number(input.bytes, slot);
      require_coordinate(input, slot.offset, position[axis]);
    }
    corners.push_back(weld.corner(position, slots));
  }
  weld.facet(corners, floats_at(offset), offset);
}

size_t promised_size(const Input& input) {
  return kHeaderSize + kTriangleSize * size_t{load<std::uint32_t>(input.bytes.data() + kHeaderSize - 4, false)};
}

void require_binary_size(const Input& input, Draft& draft) {
  const size_t size = input.bytes.size();
  if (size < kHeaderSize) {
    refuse(input, "is neither ascii STL (it does not begin with solid) nor binary STL (84 bytes at least); it is " +
                      std::string("truncated or of another format: export it again"));
  }
  const size_t promised = promised_size(input);
  if (promised > size) {
    refuse(input, kHeaderSize - 4,
           "as many triangles are promised as take " + std::to_string(promised) + " bytes, but the file has " +
               std::to_string(size) + "; it is truncated: export it again");
  }
  if (promised < size) draft.warnings.add(input, promised, "the bytes after the last triangle are kept unread");
}

void read_binary_stl(Input& input, Draft& draft) {
  input.binary = true;
  require_binary_size(input, draft);
  Welder weld(input, draft);
  std::vector<int> corners;
  const size_t end = promised_size(input);
  for (size_t at = kHeaderSize; at < end; at += kTriangleSize) read_binary_facet(input, weld, at, corners);
}

// Binary files may begin with "solid" too, so an exact size decides first.
bool is_ascii(const Input& input) {
  if (input.bytes.size() >= kHeaderSize && promised_size(input) == input.bytes.size()) return false;
  if (input.bytes.find('\0') != std::string::npos) return false;
  Scanner scan(input, text_begin(input));
  scan.skip_space();
  return same_word(scan.word(), "solid");
}

}  // namespace

void read_stl(Input& input, Draft& draft) {
  draft.source.facet_normals = true;
  if (is_ascii(input)) return AsciiStl(input, draft).read();
  read_binary_stl(input, draft);
}

}  // namespace swage
