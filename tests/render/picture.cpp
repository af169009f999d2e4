#include "picture.h"

#include <algorithm>
#include <cstdlib>

namespace swage::test {

Rgb pixel(const Image& image, int x, int y) {
  const size_t at = 3 * (static_cast<size_t>(y) * static_cast<size_t>(image.width) + static_cast<size_t>(x));
  return {image.rgb.at(at), image.rgb.at(at + 1), image.rgb.at(at + 2)};
}

int difference(const Rgb& a, const Rgb& b) {
  int most = 0;
  for (size_t k = 0; k < 3; ++k) most = std::max(most, std::abs(a[k] - b[k]));
  return most;
}

Region all_of(const Image& image) { return {0, 0, image.width, image.height}; }

int count(const Image& image, const Region& region, const std::function<bool(const Rgb&)>& is_meant) {
  int found = 0;
  for (int y = region.y0; y < region.y1; ++y) {
    for (int x = region.x0; x < region.x1; ++x) found += is_meant(pixel(image, x, y)) ? 1 : 0;
  }
  return found;
}

Region bounds(const Image& image, const Region& region, const std::function<bool(const Rgb&)>& is_meant) {
  Region found{image.width, image.height, 0, 0};
  for (int y = region.y0; y < region.y1; ++y) {
    for (int x = region.x0; x < region.x1; ++x) {
      if (!is_meant(pixel(image, x, y))) continue;
      found = {std::min(found.x0, x), std::min(found.y0, y), std::max(found.x1, x + 1), std::max(found.y1, y + 1)};
    }
  }
  return found;
}

bool is_ink(const Rgb& colour) { return difference(colour, {255, 255, 255}) > 8; }
bool is_orange(const Rgb& c) { return c[0] > 220 && c[1] > 100 && c[1] < 170 && c[2] < 60; }
bool is_red(const Rgb& c) { return c[0] > 180 && c[1] < 80 && c[2] < 80; }
bool is_dark(const Rgb& c) { return c[0] < 140 && c[1] < 140 && c[2] < 140; }

RenderOptions plain(int width, int height, const Eigen::Vector3d& from) {
  RenderOptions options;
  options.width = width;
  options.height = height;
  options.view = View{from, {0, 1, 0}};
  options.feature_lines = false;
  options.ambient_rays = 0;
  return options;
}

Panel panel_of(const Mesh& mesh) {
  Panel panel;
  panel.mesh = mesh;
  return panel;
}

}  // namespace swage::test
