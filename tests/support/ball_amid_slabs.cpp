#include "ball_amid_slabs.h"

#include <numeric>

#include "shapes.h"

namespace swage::test {
namespace {

Mesh left_slab() { return box({1, 2, 2}, 2); }
Mesh middle_ball() { return transformed(sphere(0.9, 3), 1, {3, 1, 1}); }

}  // namespace

Mesh ball_amid_slabs() { return joined(joined(left_slab(), middle_ball()), transformed(left_slab(), 1, {5, 0, 0})); }

std::vector<int> ball_triangles() {
  std::vector<int> triangles(static_cast<size_t>(middle_ball().triangles.rows()));
  std::iota(triangles.begin(), triangles.end(), static_cast<int>(left_slab().triangles.rows()));
  return triangles;
}

Positions ball_of(const Positions& positions) {
  return positions.middleRows(left_slab().positions.rows(), middle_ball().positions.rows());
}

Positions slab_of(const Positions& positions) { return positions.topRows(left_slab().positions.rows()); }

Eigen::RowVector3d extents(const Positions& positions) {
  return positions.colwise().maxCoeff() - positions.colwise().minCoeff();
}

ResizeTarget by(double x, double y, double z, ResizeKeep keep) {
  ResizeTarget target;
  target.factors << x, y, z;
  target.keep = keep;
  return target;
}

ResizeOptions coarse() {
  ResizeOptions options;
  options.longest = 20;
  return options;
}

}  // namespace swage::test
