// Text on an image, in DejaVu Sans.
#pragma once

#include <span>
#include <string>

#include "palette.h"
#include "swage/render.h"

namespace swage {

/// The bytes of the font's TrueType file.
std::span<const unsigned char> font_file();

/// Pixels that UTF-8 text takes; `size` is about the height of an upper-case letter times 1.4.
double text_width(const std::string& text, double size);

enum class Align { left, middle };

/// `at` is on the baseline.
void draw_text(Image& image, const Eigen::Vector2d& at, const std::string& text, double size, const Colour& colour,
               Align align = Align::left);

/// The same, smaller where it is wider than `room`, and cut off where that would be less than two thirds.
void draw_text_within(Image& image, double room, const Eigen::Vector2d& at, const std::string& text, double size,
                      const Colour& colour, Align align = Align::left);

}  // namespace swage
