// From space to the pixels of a panel.
#pragma once

#include <Eigen/Core>

#include "swage/render.h"

namespace swage {

/// Pixels of an image, (x, y) its upper left corner.
struct PixelBox {
  int x = 0, y = 0, width = 0, height = 0;

  Eigen::Vector2d middle() const { return {x + width / 2.0, y + height / 2.0}; }
};

/// Orthographic. Lengths are those of the scene; right, up and toward the eye are unit vectors, orthogonal.
struct Camera {
  Eigen::Vector3d right, up, toward;
  Eigen::Vector2d centre{0, 0};  ///< Along right and up, of what is in the middle of the picture.
  double scale = 1;              ///< Pixels a length.

  /// Throws InvalidInput, in the name of `function`, where the view is not finite or from nowhere.
  Camera(const View& view, const char* function);

  /// Along right and up.
  Eigen::Vector2d flat(const Eigen::Vector3d& point) const { return {right.dot(point), up.dot(point)}; }
  /// Pixels from the middle of the picture, rightwards and downwards.
  Eigen::Vector2d project(const Eigen::Vector3d& point) const {
    const Eigen::Vector2d off = scale * (flat(point) - centre);
    return {off.x(), -off.y()};
  }
  /// The point in the plane through the origin that project() takes there.
  Eigen::Vector3d unproject(const Eigen::Vector2d& pixels) const {
    return right * (centre.x() + pixels.x() / scale) + up * (centre.y() - pixels.y() / scale);
  }
};

}  // namespace swage
