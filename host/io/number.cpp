#include "number.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <limits>

namespace swage {
namespace {

// What from_chars leaves undecided: whether a number out of range is too large or too small.
bool is_too_small(std::string_view number) {
  const size_t exponent = number.find_first_of("eE");
  if (exponent != std::string_view::npos) return number.substr(exponent + 1).starts_with('-');
  return number.substr(0, number.find('.')).find_first_of("123456789") == std::string_view::npos;
}

double out_of_range(std::string_view number) {
  const double size = is_too_small(number) ? 0 : std::numeric_limits<double>::infinity();
  return number.starts_with('-') ? -size : size;
}

// A plus sign is a number's first character, not its only one and not before another sign.
size_t plus_length(std::string_view text) {
  return text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+' ? 1 : 0;
}

template <typename T>
void store(std::string& out, T value, bool big_endian) {
  auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (big_endian != (std::endian::native == std::endian::big)) std::reverse(bytes.begin(), bytes.end());
  out.append(bytes.data(), bytes.size());
}

bool is_single(NumberKind kind) { return kind == NumberKind::f32_little || kind == NumberKind::f32_big; }

}  // namespace

template <typename T>
T load(const char* from, bool big_endian) {
  std::array<char, sizeof(T)> bytes;
  std::copy_n(from, sizeof(T), bytes.begin());
  if (big_endian != (std::endian::native == std::endian::big)) std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<T>(bytes);
}

template std::int8_t load(const char*, bool);
template std::uint8_t load(const char*, bool);
template std::int16_t load(const char*, bool);
template std::uint16_t load(const char*, bool);
template std::int32_t load(const char*, bool);
template std::uint32_t load(const char*, bool);
template float load(const char*, bool);
template double load(const char*, bool);

size_t parse_number(std::string_view text, double& value) {
  const size_t plus = plus_length(text);
  const char* first = text.data() + plus;
  const auto [end, error] = std::from_chars(first, text.data() + text.size(), value);
  if (error == std::errc::invalid_argument) return 0;
  if (error == std::errc::result_out_of_range) {
    value = out_of_range({first, static_cast<size_t>(end - first)});
  }
  return static_cast<size_t>(end - text.data());
}

size_t parse_integer(std::string_view text, long long& value) {
  const size_t plus = plus_length(text);
  const char* first = text.data() + plus;
  const auto [end, error] = std::from_chars(first, text.data() + text.size(), value);
  if (error == std::errc::invalid_argument) return 0;
  if (error == std::errc::result_out_of_range) {
    using Limits = std::numeric_limits<long long>;
    value = *first == '-' ? Limits::min() : Limits::max();
  }
  return static_cast<size_t>(end - text.data());
}

double read_number(const std::string& bytes, const Slot& slot) {
  const char* from = bytes.data() + slot.offset;
  switch (slot.kind) {
    case NumberKind::f32_little:
    case NumberKind::f32_big:
      return static_cast<double>(load<float>(from, slot.kind == NumberKind::f32_big));
    case NumberKind::f64_little:
    case NumberKind::f64_big:
      return load<double>(from, slot.kind == NumberKind::f64_big);
    case NumberKind::text:
      break;
  }
  double value = 0;
  parse_number({from, slot.length}, value);
  return value;
}

void append_number(std::string& out, NumberKind kind, double value) {
  switch (kind) {
    case NumberKind::f32_little:
    case NumberKind::f32_big:
      return store(out, static_cast<float>(value), kind == NumberKind::f32_big);
    case NumberKind::f64_little:
    case NumberKind::f64_big:
      return store(out, value, kind == NumberKind::f64_big);
    case NumberKind::text:
      break;
  }
  char digits[32];
  out.append(digits, std::to_chars(std::begin(digits), std::end(digits), value).ptr);
}

void append_integer(std::string& out, long long value) {
  char digits[24];
  out.append(digits, std::to_chars(std::begin(digits), std::end(digits), value).ptr);
}

bool holds(const std::string& bytes, const Slot& slot, double value) {
  const double kept = is_single(slot.kind) ? static_cast<double>(static_cast<float>(value)) : value;
  return read_number(bytes, slot) == kept;
}

}  // namespace swage
