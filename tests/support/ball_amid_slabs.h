// A model to resize: a ball of radius 0.9 between two slabs, 6 long, 2 wide and high.
#pragma once

#include "swage/mesh.h"
#include "swage/resize.h"

namespace swage::test {

Mesh ball_amid_slabs();
/// Of its ball and its first slab, which do not share.
std::vector<int> ball_triangles();
Positions ball_of(const Positions& positions);
Positions slab_of(const Positions& positions);

Eigen::RowVector3d extents(const Positions& positions);

ResizeTarget by(double x, double y, double z, ResizeKeep keep = ResizeKeep::shape);
/// On a grid that is small and quick: 20 cells along.
ResizeOptions coarse();

}  // namespace swage::test
