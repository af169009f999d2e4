// Anti-aliased shapes on an image. Coordinates are pixels from its upper left corner; what lies outside is left out.
#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "camera.h"
#include "palette.h"
#include "swage/render.h"

namespace swage {

/// Where (x, y) stands in rows of so many.
inline size_t place(int x, int y, int columns) {
  return static_cast<size_t>(y) * static_cast<size_t>(columns) + static_cast<size_t>(x);
}

/// The part of a pixel at `at` that a line with round ends covers, in [0, 1].
float line_coverage(const Eigen::Vector2d& at, const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width);

void blend(Image& image, int x, int y, const Colour& colour, float alpha);

void fill(Image& image, const PixelBox& box, const Colour& colour);
void draw_line(Image& image, const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width,
               const Colour& colour);
void draw_disc(Image& image, const Eigen::Vector2d& middle, double radius, const Colour& colour);
void draw_triangle(Image& image, const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                   const Colour& colour);

/// Calls visit(x, y) for the pixels of a width × height picture within `reach` of the box around two points.
template <typename Visit>
void visit_around(int width, int height, const Eigen::Vector2d& a, const Eigen::Vector2d& b, double reach,
                  const Visit& visit) {
  const auto pixel = [](double at, int size) { return static_cast<int>(std::clamp(at, 0.0, double(size))); };
  const Eigen::Vector2d low = a.cwiseMin(b).array() - reach, high = a.cwiseMax(b).array() + reach + 1;
  for (int y = pixel(low.y(), height); y < pixel(high.y(), height); ++y) {
    for (int x = pixel(low.x(), width); x < pixel(high.x(), width); ++x) visit(x, y);
  }
}

}  // namespace swage
