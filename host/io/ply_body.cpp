#include "ply_body.h"

#include <algorithm>

#include "draft.h"

namespace swage {

PlyBody::PlyBody(const Input& input, const PlyHeader& header)
    : input_(input),
      scan_(input, header.end),
      is_ascii_(header.encoding == PlyHeader::Encoding::ascii),
      is_big_(header.encoding == PlyHeader::Encoding::big_endian) {}

void PlyBody::begin_element() {
  if (is_ascii_) scan_.skip_space();
}

void PlyBody::skip(PlyType type, long long count) {
  if (is_ascii_) {
    for (long long k = 0; k < count; ++k) skip_word();
  } else {
    take(size_of(type) * static_cast<size_t>(count));
  }
}

void PlyBody::skip(const PlyProperty& property) { skip(property.type, property.is_list ? list_size(property) : 1); }

long long PlyBody::list_size(const PlyProperty& list) {
  const size_t begin = at();
  const long long count = integer(list.count_type);
  require_room(input_, begin, "values of a list", count, least_size(list.type), remaining());
  return count;
}

long long PlyBody::integer(PlyType type) {
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

double PlyBody::number(PlyType type, Slot& slot) {
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

size_t PlyBody::take(size_t size) {
  const size_t begin = at();
  if (size > remaining()) refuse(input_, begin, "the file ends within an element; it is truncated: export it again");
  scan_.jump(begin + size);
  return begin;
}

void PlyBody::skip_word() {
  scan_.skip_blanks();
  const size_t begin = at();
  if (scan_.word().empty()) refuse(input_, begin, "a value is missing on this line; export the mesh again");
}

void require_room(const Input& input, const PlyBody& body, const PlyElement& element) {
  size_t least = 0;
  for (const PlyProperty& property : element.properties) {
    least += body.least_size(property.is_list ? property.count_type : property.type);
  }
  require_room(input, body.at(), "elements of kind " + in_quotes(element.name), element.count,
               std::max<size_t>(least, 1), least == 0 ? input.bytes.size() : body.remaining());
}

void skip_element(PlyBody& body, const PlyElement& element) {
  if (element.properties.empty()) return;
  for_each_value(
      body, element, [] {}, [&](size_t p) { body.skip(element.properties[p]); }, [] {});
}

std::optional<size_t> find_number(const PlyElement& element, std::string_view name) {
  for (size_t p = 0; p < element.properties.size(); ++p) {
    const PlyProperty& property = element.properties[p];
    if (property.name == name && !property.is_list && !is_integer(property.type)) return p;
  }
  return std::nullopt;
}

const PlyElement* find_element(const PlyHeader& header, std::string_view name) {
  for (const PlyElement& element : header.elements) {
    if (element.name == name) return &element;
  }
  return nullptr;
}

}  // namespace swage
