// Rays at a triangle surface and queries for what is near a point, by Embree, in single precision.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "swage/mesh.h"

namespace swage {

/// Whether this build has Embree, without which a RayScene cannot be made: Unavailable.
bool has_embree();

struct Ray {
  Eigen::Vector3f origin, direction;  ///< The latter a unit vector.
  float reach;
};

struct RayHit {
  int triangle = -1;   ///< None where negative.
  float distance = 0;  ///< From the origin.
  float u = 0, v = 0;  ///< Weights of the triangle's second and third corner.
};

/// A surface in the unit box, copied. Its lengths are exact to 1e-6. Threads may share it.
class RayScene {
 public:
  /// Whether a triangle counts. Empty: all do.
  using Accepts = std::function<bool(int triangle)>;
  /// Is told a triangle, gives the reach from there on, which never grows.
  using Visit = std::function<double(int triangle)>;

  RayScene(const Positions& positions, const Triangles& triangles);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  /// The first triangle that the ray meets, whichever way it faces, or -1. The ray starts 1e-5 behind `origin`, so that
  /// it meets what `origin` lies on, and ends as much beyond `reach`. `direction` is a unit vector.
  int first_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double reach,
                const Accepts& accepts = {}) const;

  /// The first triangle of each ray, whichever way it faces. Rays start at their origins exactly. Those that follow one
  /// another should lie near each other.
  std::vector<RayHit> first_hits(std::span<const Ray> rays) const;

  /// Whether each ray meets a triangle: 1 or 0. Likewise.
  std::vector<char> occluded(std::span<const Ray> rays) const;

  /// Visits all triangles within reach of the point, and some beyond it.
  void visit_near(const Eigen::Vector3d& point, double reach, const Visit& visit) const;

 private:
  struct Embree;
  std::unique_ptr<Embree> embree_;
};

}  // namespace swage
