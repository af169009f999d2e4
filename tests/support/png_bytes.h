// PNG files of any kind, written here without the library.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace swage::test {

enum class PngColours { grey = 0, rgb = 2, palette = 3, rgba = 6 };

struct PngSpec {
  int width = 0, height = 0;
  int depth = 8;  ///< Bits of a channel.
  PngColours colours = PngColours::rgb;
  std::string palette = {};  ///< Three bytes an entry.
};

/// `samples`: row after row, big-endian where of 16 bits.
std::string png_bytes(const PngSpec& spec, std::string_view samples);

/// Of 8 bits, where pixel(column, row) gives red, green, blue and alpha, 0 to 255, in a 32 bit number, red highest.
template <typename Pixel>
std::string rgba_png(int width, int height, const Pixel& pixel) {
  std::string samples;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::uint32_t value = pixel(x, y);
      for (const int shift : {24, 16, 8, 0}) samples += static_cast<char>(value >> shift);
    }
  }
  return png_bytes({width, height, 8, PngColours::rgba, {}}, samples);
}

/// The opaque colour of a direction: (n + 1) / 2.
std::uint32_t colour_of(double x, double y, double z);

}  // namespace swage::test
