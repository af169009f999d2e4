// The values of a PLY file, one after another.
#pragma once

#include <optional>
#include <string_view>

#include "ply_header.h"
#include "scanner.h"

namespace swage {

/// Walks through the values of the body.
class PlyBody {
 public:
  PlyBody(const Input& input, const PlyHeader& header);

  size_t at() const { return scan_.at(); }
  size_t remaining() const { return scan_.remaining(); }
  /// The fewest bytes that a value takes, the blank after it included.
  size_t least_size(PlyType type) const { return is_ascii_ ? 2 : size_of(type); }

  void begin_element();
  void skip(const PlyProperty& property);
  void skip(PlyType type, long long count);
  long long list_size(const PlyProperty& list);
  long long integer(PlyType type);
  double number(PlyType type, Slot& slot);

 private:
  size_t take(size_t size);
  void skip_word();

  const Input& input_;
  Scanner scan_;
  bool is_ascii_, is_big_;
};

/// Refuses an element that the bytes left cannot hold.
void require_room(const Input& input, const PlyBody& body, const PlyElement& element);

/// Calls read(property index) for each property of each element; and begin() and end() around each element.
template <typename Begin, typename Read, typename End>
void for_each_value(PlyBody& body, const PlyElement& element, Begin&& begin, Read&& read, End&& end) {
  for (long long k = 0; k < element.count; ++k) {
    body.begin_element();
    begin();
    for (size_t p = 0; p < element.properties.size(); ++p) read(p);
    end();
  }
}

void skip_element(PlyBody& body, const PlyElement& element);

/// The property's place, where it is a floating-point number.
std::optional<size_t> find_number(const PlyElement& element, std::string_view name);

/// Null where there is none.
const PlyElement* find_element(const PlyHeader& header, std::string_view name);

}  // namespace swage
