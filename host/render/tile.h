// A tile of a panel: rays, shadows, then colours, by one thread.
#pragma once

#include <vector>

#include "draw.h"
#include "surface_view.h"

namespace swage {

inline constexpr float kEyeDistance = 2;  // Beyond the unit box, whichever way it is looked at.

class Tile {
 public:
  /// Traces the samples of the pixels `inner` of the panel, and of some around.
  Tile(const SurfaceView& view, const PixelBox& inner);

  bool is_empty() const { return is_empty_; }
  void find_ambience(const Ambience& ambience);
  /// Gives the number of pixels that show the surface.
  long paint(Image& image) const;

 private:
  struct Sample {
    int triangle = -1;
    float depth = 0;  ///< Towards the eye.
    Eigen::Vector3f point;
    Eigen::Vector3f flat;    ///< The triangle's normal, towards the eye.
    Eigen::Vector3f normal;  ///< The smooth one.
  };
  /// A pixel's ambience, found at one of its samples.
  struct Open {
    const Sample* at = nullptr;
    float part = 1;
  };

  Sample sample_of(const Ray& ray, const RayHit& hit) const;
  const Sample& sample(int x, int y) const { return samples_[place(x, y, columns_)]; }
  const Sample* first_sample(int x, int y) const;
  bool are_alike(const Sample& a, const Sample& b) const;
  float ambience_at(const Sample& sample, int x, int y) const;
  float slope(const Sample& sample, int x, int y) const;
  bool is_before(const Sample& sample, int x, int y, int dx, int dy) const;
  bool is_outline(int x, int y) const;
  Colour colour_of(int x, int y, const Open& middle) const;

  const SurfaceView& view_;
  PixelBox inner_, outer_;  ///< Pixels of the panel; the outer ones may lie beyond it.
  int columns_;             ///< Samples a row.
  float pixel_;             ///< Width of a sample in the scene.
  bool is_empty_ = true;
  std::vector<Sample> samples_;
  std::vector<Open> open_;  ///< A pixel of `outer_`.
};

}  // namespace swage
