#include "png_bytes.h"

#include <algorithm>
#include <cmath>

namespace swage::test {
namespace {

std::string number(std::uint32_t value) {
  std::string bytes;
  for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(value >> shift);
  return bytes;
}

std::uint32_t crc(std::string_view bytes) {
  std::uint32_t sum = 0xFFFFFFFF;
  for (const char c : bytes) {
    sum ^= static_cast<unsigned char>(c);
    for (int k = 0; k < 8; ++k) sum = (sum >> 1) ^ ((sum & 1) != 0 ? 0xEDB88320 : 0);
  }
  return ~sum;
}

std::string chunk(const std::string& type, const std::string& data) {
  return number(static_cast<std::uint32_t>(data.size())) + type + data + number(crc(type + data));
}

/// In stored blocks (RFC 1950, 1951).
std::string zlib(const std::string& data) {
  std::string out = "\x78\x01";
  for (size_t at = 0; at < data.size() || at == 0; at += 65535) {
    const size_t length = std::min<size_t>(65535, data.size() - at);
    out += at + length == data.size() ? '\1' : '\0';
    for (const size_t n : {length, ~length}) out += {static_cast<char>(n), static_cast<char>(n >> 8)};
    out.append(data, at, length);
  }
  std::uint32_t a = 1, b = 0;
  for (const char c : data) {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  return out + number(b << 16 | a);
}

}  // namespace

std::string png_bytes(const PngSpec& spec, std::string_view samples) {
  const size_t row = samples.size() / static_cast<size_t>(spec.height);
  std::string data;
  for (size_t at = 0; at < samples.size(); at += row) data += '\0' + std::string(samples.substr(at, row));
  std::string header = number(static_cast<std::uint32_t>(spec.width)) + number(static_cast<std::uint32_t>(spec.height));
  header += {static_cast<char>(spec.depth), static_cast<char>(spec.colours), '\0', '\0', '\0'};
  std::string file = "\x89PNG\r\n\x1A\n" + chunk("IHDR", header);
  if (!spec.palette.empty()) file += chunk("PLTE", spec.palette);
  return file + chunk("IDAT", zlib(data)) + chunk("IEND", "");
}

std::uint32_t colour_of(double x, double y, double z) {
  const auto byte = [](double n) { return static_cast<std::uint32_t>(std::lround(255 * (n + 1) / 2)); };
  return byte(x) << 24 | byte(y) << 16 | byte(z) << 8 | 255;
}

}  // namespace swage::test
