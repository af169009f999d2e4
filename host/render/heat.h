// Numbers as colours, and the bar that tells which.
#pragma once

#include <vector>

#include "camera.h"
#include "palette.h"
#include "swage/render.h"

namespace swage {

/// From pale sand over green and blue to dark violet, `part` in [0, 1].
Colour ramp(double part);

/// Grey where the value is NaN.
Colour heat_colour(const HeatMap& heat, double value);

/// Round numbers in [low, high], 3 to 7 of them, ascending.
std::vector<double> ticks(double low, double high);

/// The colours of the bar are those of its pixels' middles, from low at the left of `bar` to high at its right; the
/// label is above it, ticks below. `is_exceeded`: some values are above high.
void draw_colour_bar(Image& image, const PixelBox& bar, const HeatMap& heat, bool is_exceeded, double text_size);

}  // namespace swage
