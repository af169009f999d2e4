// PLY, ascii and binary of both byte orders.
#include <algorithm>
#include <optional>

#include "draft.h"
#include "ply_header.h"
#include "scanner.h"

namespace swage {
namespace {

// Walks through the values of the body.
class PlyBody {
 public:
  PlyBody(const Input& input, const PlyHeader& header)
      : input_(input),
        scan_(input, header.end),
        is_ascii_(header.encoding == PlyHeader::Encoding::ascii),
        is_big_(header.encoding == PlyHeader::Encoding::big_endian) {}

  size_t at() const { return scan_.at(); }
  size_t remaining() const { return scan_.remaining(); }
  /// The fewest bytes that a value takes, the blank after it included.
  size_t least_size(PlyType type) const { return is_ascii_ ? 2 : size_of(type); }

  void begin_element() {
    if (is_ascii_) scan_.skip_space();
  }

  void skip(PlyType type, long long count = 1) {
    if (is_ascii_) {
      for (long long k = 0; k < count; ++k) skip_word();
    } else {
      take(size_of(type) * static_cast<size_t>(count));
    }
  }

  void skip(const PlyProperty& property) { skip(property.type, property.is_list ? list_size(property) : 1); }

  long long list_size(const PlyProperty& list) {
    const size_t begin = at();
    const long long count = integer(list.count_type);
    require_room(input_, begin, "values of a list", count, least_size(list.type), remaining());
    return count;
  }

  long long integer(PlyType type) {
    if (is_ascii_) {
      scan_.skip_blanks();
      return scan_.integer("an integer");
    }
    const char* from = input_.bytes.data() + take(size_of(type));
    switch (type) {
      case PlyType::int8:
        return load<std::int8_t>(from, is_big_);
      case PlyType::uint8:
        return load<std::uint8_t>(from, is_big_);
      case PlyType::int16:
        return load<std::int16_t>(from, is_big_);
      case PlyType::uint16:
        return load<std::uint16_t>(from, is_big_);
      case PlyType::int32:
        return load<std::int32_t>(from, is_big_);
      default:
        return load<std::uint32_t>(from, is_big_);
    }
  }

  double number(PlyType type, Slot& slot) {
    if (is_ascii_) {
      scan_.skip_blanks();
      return scan_.number(slot, "a number");
    }
    const bool is_double = type == PlyType::float64;
    const NumberKind kind = is_double ? (is_big_ ? NumberKind::f64_big : NumberKind::f64_little)
                                      : (is_big_ ? NumberKind::f32_big : NumberKind::f32_little);
    slot = {take(size_of(type)), static_cast<std::uint32_t>(size_of(type)), kind};
    return read_number(input_.bytes, slot);
  }

 private:
  size_t take(size_t size) {
    const size_t begin = at();
    if (size > remaining()) refuse(input_, begin, "the file ends within an element; it is truncated: export it again");
    scan_.jump(begin + size);
    return begin;
  }

  void skip_word() {
    scan_.skip_blanks();
    const size_t begin = at();
    if (scan_.word().empty()) refuse(input_, begin, "a value is missing on this line; export the mesh again");
  }

  const Input& input_;
  Scanner scan_;
  bool is_ascii_, is_big_;
};

void require_room(const Input& input, const PlyBody& body, const PlyElement& element) {
  size_t least = 0;
  for (const PlyProperty& property : element.properties) {
    least += body.least_size(property.is_list ? property.count_type : property.type);
  }
  require_room(input, body.at(), "elements of kind " + in_quotes(element.name), element.count,
               std::max<size_t>(least, 1), least == 0 ? input.bytes.size() : body.remaining());
}

// Calls read(property index) for each property of each element; and begin() and end() around each element.
template <typename Begin, typename Read, typename End>
void for_each_value(PlyBody& body, const PlyElement& element, Begin&& begin, Read&& read, End&& end) {
  for (long long k = 0; k < element.count; ++k) {
    body.begin_element();
    begin();
    for (size_t p = 0; p < element.properties.size(); ++p) read(p);
    end();
  }
}

// The property's place, where it is a floating-point number.
std::optional<size_t> find_number(const PlyElement& element, std::string_view name) {
  for (size_t p = 0; p < element.properties.size(); ++p) {
    const PlyProperty& property = element.properties[p];
    if (property.name == name && !property.is_list && !is_integer(property.type)) return p;
  }
  return std::nullopt;
}

constexpr size_t kOther = 6;

// For each property 0, 1, 2 for x, y, z and 3, 4, 5 for nx, ny, nz.
std::vector<size_t> vertex_roles(const Input& input, const PlyElement& vertex, bool& has_normals) {
  static constexpr std::string_view kNames[] = {"x", "y", "z", "nx", "ny", "nz"};
  has_normals = find_number(vertex, "nx") && find_number(vertex, "ny") && find_number(vertex, "nz");
  std::vector<size_t> roles(vertex.properties.size(), kOther);
  for (size_t k = 0; k < (has_normals ? 6u : 3u); ++k) {
    const auto found = find_number(vertex, kNames[k]);
    if (!found) {
      refuse(input, vertex.offset,
             "vertices have no property " + std::string(kNames[k]) +
                 " of type float or double; export the mesh with such coordinates");
    }
    roles[*found] = k;
  }
  return roles;
}

void read_vertices(const Input& input, PlyBody& body, const PlyElement& element, Draft& draft) {
  bool has_normals = false;
  const std::vector<size_t> roles = vertex_roles(input, element, has_normals);
  Slots slots, normal_slots;
  Eigen::Vector3d position;
  auto read = [&](size_t p) {
    const PlyProperty& property = element.properties[p];
    if (roles[p] == kOther) return body.skip(property);
    const size_t axis = roles[p] % 3;
    Slot& slot = (roles[p] < 3 ? slots : normal_slots)[axis];
    const double value = body.number(property.type, slot);
    if (roles[p] >= 3) return;
    require_coordinate(input, slot.offset, value);
    position[static_cast<int>(axis)] = value;
  };
  for_each_value(
      body, element, [] {}, read,
      [&] {
        add_point(draft, add_vertex(input, draft, position, slots[0].offset), slots);
        if (has_normals) draft.source.normals.push_back(normal_slots);
      });
}

bool is_corner_list(const PlyProperty& property) {
  return property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index");
}

void read_faces(const Input& input, PlyBody& body, const PlyElement& element, long long vertex_count, Draft& draft) {
  const auto& properties = element.properties;
  const auto list = std::find_if(properties.begin(), properties.end(), is_corner_list);
  if (list == properties.end() || !is_integer(list->type)) {
    refuse(input, element.offset, "faces have no list vertex_indices of integers; export the mesh again");
  }
  size_t begin = 0;
  std::vector<int> corners;
  auto read = [&](size_t p) {
    if (&properties[p] != &*list) return body.skip(properties[p]);
    const long long count = body.list_size(*list);
    corners.clear();
    for (long long k = 0; k < count; ++k) {
      const size_t offset = body.at();
      corners.push_back(checked_index(input, offset, body.integer(list->type), vertex_count));
    }
  };
  for_each_value(
      body, element, [&] { begin = body.at(); }, read, [&] { add_polygon(input, draft, corners, begin); });
}

void skip_element(PlyBody& body, const PlyElement& element) {
  if (element.properties.empty()) return;
  for_each_value(
      body, element, [] {}, [&](size_t p) { body.skip(element.properties[p]); }, [] {});
}

const PlyElement* find_element(const PlyHeader& header, std::string_view name) {
  for (const PlyElement& element : header.elements) {
    if (element.name == name) return &element;
  }
  return nullptr;
}

void require_faces(const Input& input, const PlyHeader& header) {
  if (!find_element(header, "vertex")) refuse(input, "has no vertex element; export it as a mesh");
  if (find_element(header, "face")) return;
  refuse(input, find_element(header, "tristrips") ? "has triangle strips instead of faces; export it with faces"
                                                  : "has no face element; export it as a mesh, not as points");
}

}  // namespace

void read_ply(Input& input, Draft& draft) {
  const PlyHeader header = read_ply_header(input);
  require_faces(input, header);
  const bool is_text = header.encoding == PlyHeader::Encoding::ascii;
  if (is_text) require_text(input);
  input.binary = !is_text;
  PlyBody body(input, header);
  const long long vertex_count = find_element(header, "vertex")->count;
  for (const PlyElement& element : header.elements) {
    require_room(input, body, element);
    if (element.name == "vertex") {
      read_vertices(input, body, element, draft);
    } else if (element.name == "face") {
      read_faces(input, body, element, vertex_count, draft);
    } else {
      skip_element(body, element);
    }
  }
  if (!draft.source.normals.empty()) use_vertex_normals(draft);
}

}  // namespace swage
