// A surface as it is seen in one panel, without its lines and handles.
#pragma once

#include "camera.h"
#include "scene.h"
#include "watch.h"

namespace swage {

struct SurfaceView {
  const RenderScene& scene;
  const Camera& camera;
  PixelBox box;  ///< In the image.
  int supersampling;
  int ambient_rays;
  double outline;  ///< Width in pixels; 0 for none.

  /// Starting outside the unit box, to beyond it.
  Ray ray_at(const Eigen::Vector2d& pixel) const;
};

/// Draws it, and tells how many pixels show some of it. False where `watch` says to stop.
bool draw_surface(Image& image, const SurfaceView& view, long& covered, const Watch& watch);

/// From cosine-weighted rays out of a point of a surface, the part that meets none of it within reach.
/// `pattern` in [0, 64) says which rays: the patterns together are evenly spread.
class Ambience {
 public:
  explicit Ambience(int rays);
  std::vector<Ray> rays_from(const Eigen::Vector3f& point, const Eigen::Vector3f& normal, int pattern) const;

 private:
  int count_;
  std::vector<Eigen::Vector3f> directions_;  ///< About the z axis.
};

/// What a colour is multiplied with where the surface has this normal, towards the eye, and ambience in [0, 1]: 1 where
/// it faces the eye openly; a plain surface may be a little lighter elsewhere, a heat map's shades are milder.
float light_at(const SurfaceView& view, const Eigen::Vector3f& normal, float ambience);

}  // namespace swage
