// Rays at a triangle surface and queries for what is near a point, by Embree, in single precision.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>

#include "swage/mesh.h"

namespace swage {

/// Whether this build has Embree, without which a RayScene cannot be made: Unavailable.
bool has_embree();

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

  /// Visits all triangles within reach of the point, and some beyond it.
  void visit_near(const Eigen::Vector3d& point, double reach, const Visit& visit) const;

 private:
  struct Embree;
  std::unique_ptr<Embree> embree_;
};

}  // namespace swage
