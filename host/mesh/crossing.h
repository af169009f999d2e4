// Whether two triangles cross: an exact decision.
#pragma once

#include <Eigen/Core>
#include <array>

namespace swage {

struct Corners {
  std::array<Eigen::Vector3d, 3> points;
  std::array<int, 3> vertices;  ///< Their names: equal where, and only where, points are.
};

/// Whether the corners are not collinear.
bool spans_a_plane(const Corners& triangle);

/// Whether two triangles, each of which spans a plane, have a point in common beyond the vertex or the edge that they
/// share. Touching counts, and so do three shared vertices. Exact as orient3d is.
bool cross(const Corners& a, const Corners& b);

}  // namespace swage
