// Handles on a panel, and what they mean.
#pragma once

#include <functional>

#include "camera.h"

namespace swage {

/// Draws dots and arrows; `pixel_of` gives where in the image a point in mesh units is. `radius` is a dot's, pixels.
void draw_marks(Image& image, const std::vector<HandleMark>& marks,
                const std::function<Eigen::Vector2d(const Eigen::Vector3d&)>& pixel_of, double radius);

/// A radius that leaves the surface in sight, the smaller the more marks there are.
double mark_radius(size_t count, double unit);

struct MarkKinds {
  bool held = false, moved = false;

  void add(const std::vector<HandleMark>& marks);
  bool any() const { return held || moved; }
};

/// What the dots mean, on a line whose left end is at `at`.
void draw_mark_legend(Image& image, const Eigen::Vector2d& at, const MarkKinds& kinds, double unit);

}  // namespace swage
