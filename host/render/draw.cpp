#include "draw.h"

#include <cmath>

namespace swage {
namespace {

Eigen::Vector2d middle_of(int x, int y) { return {x + 0.5, y + 0.5}; }

float coverage_of(double inside) { return static_cast<float>(std::clamp(inside + 0.5, 0.0, 1.0)); }

}  // namespace

float line_coverage(const Eigen::Vector2d& at, const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width) {
  const Eigen::Vector2d along = to - from, off = at - from;
  const double length = along.squaredNorm();
  const double part = length > 0 ? std::clamp(off.dot(along) / length, 0.0, 1.0) : 0;
  return coverage_of(width / 2 - (off - part * along).norm());
}

void blend(Image& image, int x, int y, const Colour& colour, float alpha) {
  unsigned char* pixel = &image.rgb[3 * place(x, y, image.width)];
  for (int k = 0; k < 3; ++k) {
    const float mixed = (1 - alpha) * pixel[k] + alpha * 255 * std::clamp(colour[k], 0.0F, 1.0F);
    pixel[k] = static_cast<unsigned char>(std::lround(mixed));
  }
}

void fill(Image& image, const PixelBox& box, const Colour& colour) {
  for (int y = std::max(0, box.y); y < std::min(image.height, box.y + box.height); ++y) {
    for (int x = std::max(0, box.x); x < std::min(image.width, box.x + box.width); ++x) blend(image, x, y, colour, 1);
  }
}

void draw_line(Image& image, const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width,
               const Colour& colour) {
  visit_around(image.width, image.height, from, to, width / 2 + 1, [&](int x, int y) {
    const float coverage = line_coverage(middle_of(x, y), from, to, width);
    if (coverage > 0) blend(image, x, y, colour, coverage);
  });
}

void draw_disc(Image& image, const Eigen::Vector2d& middle, double radius, const Colour& colour) {
  draw_line(image, middle, middle, 2 * radius, colour);
}

void draw_triangle(Image& image, const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                   const Colour& colour) {
  // How far inside a side, with the third corner on the positive one.
  const auto inside = [](const Eigen::Vector2d& at, const Eigen::Vector2d& p, const Eigen::Vector2d& q,
                         const Eigen::Vector2d& third) {
    const Eigen::Vector2d normal = Eigen::Vector2d(p.y() - q.y(), q.x() - p.x()).normalized();
    return normal.dot(at - p) * (normal.dot(third - p) < 0 ? -1 : 1);
  };
  visit_around(image.width, image.height, a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c), 1, [&](int x, int y) {
    const Eigen::Vector2d at = middle_of(x, y);
    const float coverage = coverage_of(std::min({inside(at, a, b, c), inside(at, b, c, a), inside(at, c, a, b)}));
    if (coverage > 0) blend(image, x, y, colour, coverage);
  });
}

}  // namespace swage
