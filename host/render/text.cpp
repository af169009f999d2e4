#include "text.h"

#include <cmath>
#include <vector>

#include "draw.h"
#include "swage/error.h"

#define STBTT_STATIC
#define STB_TRUETYPE_IMPLEMENTATION
#include <stb/stb_truetype.h>

namespace swage {
namespace {

constexpr int kUnreadable = 0xFFFD;

const stbtt_fontinfo& font() {
  static const stbtt_fontinfo kInfo = [] {
    stbtt_fontinfo made;
    if (stbtt_InitFont(&made, font_file().data(), 0) == 0) throw Unavailable("text: the font built in is broken");
    return made;
  }();
  return kInfo;
}

float scale_of(double size) { return stbtt_ScaleForMappingEmToPixels(&font(), static_cast<float>(size)); }

/// How many bytes of a character follow its first one; -1 where none begins so.
int followers(unsigned char first) {
  if (first < 0x80) return 0;
  if (first >= 0xC2 && first < 0xE0) return 1;
  if (first >= 0xE0 && first < 0xF0) return 2;
  return first >= 0xF0 && first < 0xF5 ? 3 : -1;
}

std::vector<int> code_points(const std::string& text) {
  std::vector<int> points;
  for (size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i++]);
    int more = followers(first);
    int point = more < 0 ? kUnreadable : more == 0 ? first : first & (0x3F >> more);
    for (; more > 0 && i < text.size() && (text[i] & 0xC0) == 0x80; --more) point = point << 6 | (text[i++] & 0x3F);
    points.push_back(more > 0 || point < ' ' ? kUnreadable : point);
  }
  return points;
}

std::string without_last(std::string text) {
  while (!text.empty() && (text.back() & 0xC0) == 0x80) text.pop_back();
  if (!text.empty()) text.pop_back();
  return text;
}

double advance(const std::vector<int>& points, size_t i) {
  int width = 0, bearing = 0;
  stbtt_GetCodepointHMetrics(&font(), points[i], &width, &bearing);
  return width + (i + 1 < points.size() ? stbtt_GetCodepointKernAdvance(&font(), points[i], points[i + 1]) : 0);
}

/// With its origin at `at`, to a fraction of a pixel across and to whole ones down, which keeps lines sharp.
void draw_glyph(Image& image, const Eigen::Vector2d& at, int point, float scale, const Colour& colour) {
  const double left = std::floor(at.x());
  const auto shift = static_cast<float>(at.x() - left);
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  stbtt_GetCodepointBitmapBoxSubpixel(&font(), point, scale, scale, shift, 0, &x0, &y0, &x1, &y1);
  const int width = x1 - x0, height = y1 - y0;
  if (width <= 0 || height <= 0) return;
  std::vector<unsigned char> ink(place(0, height, width));
  stbtt_MakeCodepointBitmapSubpixel(&font(), ink.data(), width, height, width, scale, scale, shift, 0, point);
  const int corner_x = static_cast<int>(left) + x0, corner_y = static_cast<int>(std::lround(at.y())) + y0;
  for (int y = std::max(0, -corner_y); y < std::min(height, image.height - corner_y); ++y) {
    for (int x = std::max(0, -corner_x); x < std::min(width, image.width - corner_x); ++x) {
      const unsigned char alpha = ink[place(x, y, width)];
      if (alpha > 0) blend(image, corner_x + x, corner_y + y, colour, static_cast<float>(alpha) / 255);
    }
  }
}

}  // namespace

double text_width(const std::string& text, double size) {
  const std::vector<int> points = code_points(text);
  double sum = 0;
  for (size_t i = 0; i < points.size(); ++i) sum += advance(points, i);
  return sum * scale_of(size);
}

void draw_text(Image& image, const Eigen::Vector2d& at, const std::string& text, double size, const Colour& colour,
               Align align) {
  const std::vector<int> points = code_points(text);
  const float scale = scale_of(size);
  double x = align == Align::left ? at.x() : at.x() - text_width(text, size) / 2;
  for (size_t i = 0; i < points.size(); ++i) {
    draw_glyph(image, {x, at.y()}, points[i], scale, colour);
    x += advance(points, i) * scale;
  }
}

void draw_text_within(Image& image, double room, const Eigen::Vector2d& at, const std::string& text, double size,
                      const Colour& colour, Align align) {
  const double fitting = std::clamp(size * room / std::max(1.0, text_width(text, size)), size * 2 / 3, size);
  std::string shown = text;
  for (std::string kept = text; !kept.empty() && text_width(shown, fitting) > room * (1 + 1e-6); shown = kept + "…") {
    kept = without_last(std::move(kept));
  }
  draw_text(image, at, shown, fitting, colour, align);
}

}  // namespace swage
