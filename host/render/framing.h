// What is seen of a group of panels, and from where.
#pragma once

#include <span>

#include "camera.h"
#include "measures.h"

namespace swage {

/// What every function here checks of its panels. Throws InvalidInput in the name of `function`.
void check_panel(const Panel& panel, size_t index, const char* function);

/// The positions of vertices that triangles have, of all panels. Throws InvalidInput where they are at one place.
Positions seen_positions(std::span<const Panel> panels, const char* function);

/// Panels seen at the same scale: their vertices and handles fit in `extent` around the camera's centre.
struct Framing {
  UnitBox box;
  Camera camera;           ///< Its scale is left open.
  Eigen::Vector2d extent;  ///< Along right and up, unit boxes.
};

Framing framing_of(std::span<const Panel> panels, const View& view, const char* function);

/// Pixels a unit box at which the extent fits, with room for `margin` pixels around it.
double fitting_scale(const Eigen::Vector2d& extent, const PixelBox& box, double margin);

Eigen::Vector3d into(const UnitBox& box, const Eigen::Vector3d& point);

}  // namespace swage
