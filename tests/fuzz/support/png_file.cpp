#include "png_file.h"

namespace swage::fuzz {
namespace {

unsigned long long number(std::string_view png, size_t at) {
  unsigned long long value = 0;
  for (const char c : png.substr(at, 4)) value = value << 8 | static_cast<unsigned char>(c);
  return value;
}

}  // namespace

bool takes_long(std::string_view png, unsigned long long pixels) {
  constexpr unsigned long long kRefused = 1ULL << 26;
  if (png.size() < 24) return false;
  const unsigned long long count = number(png, 16) * number(png, 20);
  return count > pixels && count <= kRefused;
}

}  // namespace swage::fuzz
