// The foot of a point on a surface: rays find one near by, and none nearer is passed by.
#pragma once

#include <vector>

#include "foot.h"
#include "rays_embree.h"

namespace swage {

/// `count` unit vectors, evenly over the sphere: a spherical Fibonacci set.
std::vector<Eigen::Vector3d> sphere_directions(int count);

/// Of a surface in the unit box. Threads may share it.
class FootSearch {
 public:
  FootSearch(Mesh mesh, int directions);

  /// The closest foot whose triangle faces `normal`'s way, where one is no more than `detour` times as far as the
  /// closest of all; else that.
  Foot operator()(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, double detour) const;

 private:
  /// Of triangles that `accepts`. None where all of those are farther than `reach`, or one a little farther.
  Foot closest(const Eigen::Vector3d& point, double reach, const RayScene::Accepts& accepts) const;

  Mesh mesh_;
  RayScene scene_;
  Positions normals_;
  std::vector<Eigen::Vector3d> directions_;
};

}  // namespace swage
