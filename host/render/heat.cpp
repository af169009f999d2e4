#include "heat.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "draw.h"
#include "text.h"

namespace swage {
namespace {

/// Oklab (Ottosson 2020), in which equal distances look alike: lightness, then greenish to reddish, bluish to
/// yellowish. Lightness falls evenly from stop to stop, so that the order of colours is seen without their hues.
const std::array<Eigen::Vector3d, 6> kStops{{{0.950, -0.012, 0.052},
                                             {0.825, -0.070, 0.092},
                                             {0.700, -0.098, 0.030},
                                             {0.575, -0.062, -0.052},
                                             {0.450, 0.000, -0.118},
                                             {0.325, 0.062, -0.112}}};

double encoded(double linear) {
  const double light = std::clamp(linear, 0.0, 1.0);
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

Colour srgb(const Eigen::Vector3d& lab) {
  const double l = std::pow(lab[0] + 0.3963377774 * lab[1] + 0.2158037573 * lab[2], 3);
  const double m = std::pow(lab[0] - 0.1055613458 * lab[1] - 0.0638541728 * lab[2], 3);
  const double s = std::pow(lab[0] - 0.0894841775 * lab[1] - 1.2914855480 * lab[2], 3);
  const Eigen::Vector3d rgb(encoded(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
                            encoded(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
                            encoded(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s));
  return rgb.cast<float>();
}

/// The largest of 1, 2 and 5 times a power of ten that divides the range into at least three.
double tick_step(double range) {
  const double power = std::pow(10, std::floor(std::log10(range / 3)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * power * 3 <= range * (1 + 1e-9)) return factor * power;
  }
  return power;
}

std::string tick_text(double value, double step) {
  std::array<char, 64> text;
  const double size = std::max(std::abs(value), step);
  if (size >= 1e6 || step < 1e-5) {
    std::snprintf(text.data(), text.size(), "%.3g", value);
  } else {
    const int digits = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
    std::snprintf(text.data(), text.size(), "%.*f", digits, value);
  }
  return text.data();
}

}  // namespace

Colour ramp(double part) {
  const double at = std::clamp(part, 0.0, 1.0) * (kStops.size() - 1);
  const size_t k = std::min(static_cast<size_t>(at), kStops.size() - 2);
  const double beyond = at - static_cast<double>(k);
  return srgb((1 - beyond) * kStops[k] + beyond * kStops[k + 1]);
}

Colour heat_colour(const HeatMap& heat, double value) {
  return std::isnan(value) ? palette::kUnknown : ramp((value - heat.low) / (heat.high - heat.low));
}

std::vector<double> ticks(double low, double high) {
  const double step = tick_step(high - low);
  std::vector<double> values;
  for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step && values.size() < 10; ++k) {
    values.push_back(k * step + 0.0);
  }
  return values;
}

void draw_colour_bar(Image& image, const PixelBox& bar, const HeatMap& heat, bool is_exceeded, double text_size) {
  for (int x = 0; x < bar.width; ++x) {
    fill(image, {bar.x + x, bar.y, 1, bar.height}, ramp((x + 0.5) / bar.width));
  }
  const double baseline = bar.y + bar.height + 1.35 * text_size;
  draw_text(image, {bar.middle().x(), bar.y - 0.55 * text_size}, heat.label, text_size, palette::kText, Align::middle);
  const std::vector<double> values = ticks(heat.low, heat.high);
  for (const double value : values) {
    const double x = bar.x + bar.width * (value - heat.low) / (heat.high - heat.low);
    fill(image,
         {std::clamp(static_cast<int>(x), bar.x, bar.x + bar.width - 1), bar.y + bar.height, 1,
          std::max(2, static_cast<int>(text_size / 4))},
         palette::kFaintText);
    std::string text = tick_text(value, tick_step(heat.high - heat.low));
    if (is_exceeded && value == values.back() && value > heat.high * (1 - 1e-9)) text = "≥ " + text;
    draw_text(image, {x, baseline}, text, text_size, palette::kFaintText, Align::middle);
  }
}

}  // namespace swage
