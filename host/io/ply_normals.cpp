#include "ply_normals.h"

#include <array>
#include <vector>

#include "ply_body.h"

namespace swage {
namespace {

constexpr size_t kNoNormal = 3;

/// For each property 0, 1, 2 for nx, ny, nz; empty where one is missing.
std::vector<size_t> normal_roles(const PlyElement& element) {
  static constexpr std::array<std::string_view, 3> kNames{"nx", "ny", "nz"};
  std::vector<size_t> roles(element.properties.size(), kNoNormal);
  for (size_t k = 0; k < 3; ++k) {
    const auto found = find_number(element, kNames[k]);
    if (!found) return {};
    roles[*found] = k;
  }
  return roles;
}

Positions normals_of(PlyBody& body, const PlyElement& element) {
  const std::vector<size_t> roles = normal_roles(element);
  if (roles.empty()) {
    skip_element(body, element);
    return {};
  }
  std::vector<double> numbers;
  std::array<double, 3> normal{};
  long long corners = 0;
  const auto read = [&](size_t p) {
    const PlyProperty& property = element.properties[p];
    Slot slot;
    if (roles[p] != kNoNormal) {
      normal[roles[p]] = body.number(property.type, slot);
    } else if (property.is_list) {
      const long long count = body.list_size(property);
      if (property.name.starts_with("vertex_ind")) corners = count;
      body.skip(property.type, count);
    } else {
      body.skip(property);
    }
  };
  for_each_value(
      body, element, [] {}, read,
      [&] {
        if (element.name == "face" && corners < 3) return;
        numbers.insert(numbers.end(), normal.begin(), normal.end());
      });
  return Eigen::Map<const Positions>(numbers.data(), static_cast<Eigen::Index>(numbers.size() / 3), 3);
}

}  // namespace

PlyNormals read_ply_normals(Input& input) {
  const PlyHeader header = read_ply_header(input);
  const bool is_text = header.encoding == PlyHeader::Encoding::ascii;
  if (is_text) require_text(input);
  input.binary = !is_text;
  PlyBody body(input, header);
  PlyNormals normals;
  for (const PlyElement& element : header.elements) {
    require_room(input, body, element);
    if (element.name == "vertex") {
      normals.vertices = normals_of(body, element);
    } else if (element.name == "face") {
      normals.faces = normals_of(body, element);
    } else {
      skip_element(body, element);
    }
  }
  return normals;
}

}  // namespace swage
