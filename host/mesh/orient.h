// On which side a point lies: exact decisions.
#pragma once

#include <Eigen/Core>

namespace swage {

/// Exact where coordinates are zero or of a magnitude in [2^-300, 2^300].
///
/// The side of the plane a b c on which d lies: 1 where a b c run counter-clockwise seen from d, -1 where clockwise,
/// 0 where the four are coplanar. Rounded arithmetic with a forward error bound, exact expansions where that leaves the
/// sign open (Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates, 1997).
int orient3d(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& d);

/// The same of a line: 1 where a b c run counter-clockwise, 0 where they are collinear.
int orient2d(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

}  // namespace swage
