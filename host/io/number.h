// Numbers as files hold them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace swage {

enum class NumberKind : std::uint8_t { text, f32_little, f32_big, f64_little, f64_big };

/// Where in a file a number stands.
struct Slot {
  size_t offset = 0;
  std::uint32_t length = 0;
  NumberKind kind = NumberKind::text;
};
using Slots = std::array<Slot, 3>;

/// The decimal number that `text` begins with: how many characters it takes, 0 where there is none. Too large a
/// number is infinite, too small a one zero; "nan" and "inf" are numbers here.
size_t parse_number(std::string_view text, double& value);

/// The same for integers; an integer beyond 64 bits is the nearest within.
size_t parse_integer(std::string_view text, long long& value);

double read_number(const std::string& bytes, const Slot& slot);

/// Text is the shortest that reads back as the same double; float32 is rounded.
void append_number(std::string& out, NumberKind kind, double value);
void append_integer(std::string& out, long long value);

/// Whether the slot already holds `value`, as precisely as its kind can. Zeros of both signs are equal.
bool holds(const std::string& bytes, const Slot& slot, double value);

/// An arithmetic value at `from`, of either byte order.
template <typename T>
T load(const char* from, bool big_endian);

}  // namespace swage
