// What is in a picture.
#pragma once

#include <array>
#include <functional>

#include "swage/render.h"

namespace swage::test {

using Rgb = std::array<int, 3>;

Rgb pixel(const Image& image, int x, int y);
/// Largest difference of a channel.
int difference(const Rgb& a, const Rgb& b);

struct Region {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  ///< The last ones are outside.
};
Region all_of(const Image& image);

int count(const Image& image, const Region& region, const std::function<bool(const Rgb&)>& is_meant);
/// The smallest region with all such pixels; x1 = 0 where there is none.
Region bounds(const Image& image, const Region& region, const std::function<bool(const Rgb&)>& is_meant);

bool is_ink(const Rgb& colour);  ///< Not white.
bool is_orange(const Rgb& colour);
bool is_red(const Rgb& colour);
bool is_dark(const Rgb& colour);

/// One panel with nothing around, as plain as can be: no lines, no shadows.
RenderOptions plain(int width, int height, const Eigen::Vector3d& from = {0, 0, 1});

Panel panel_of(const Mesh& mesh);

}  // namespace swage::test
