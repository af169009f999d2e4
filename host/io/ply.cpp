// PLY, ascii and binary of both byte orders.
#include <algorithm>

#include "draft.h"
#include "ply_body.h"

namespace swage {
namespace {

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
