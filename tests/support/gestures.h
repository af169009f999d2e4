// Gestures that tests ask for.
#pragma once

#include "swage/handles.h"
#include "swage/mesh.h"

namespace swage::test {

/// Every `stride`-th vertex goes where the map takes it.
Gesture carried_by(const Mesh& mesh, const Eigen::Matrix3d& linear, const Eigen::Vector3d& translation, int stride = 9);

/// Every `stride`-th vertex is held, each moved another way.
Gesture uneven(const Mesh& mesh, double by, int stride = 15);

}  // namespace swage::test
