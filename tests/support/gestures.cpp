#include "gestures.h"

#include <cmath>

namespace swage::test {

Gesture carried_by(const Mesh& mesh, const Eigen::Matrix3d& linear, const Eigen::Vector3d& translation, int stride) {
  Gesture gesture;
  for (int v = 0; v < mesh.positions.rows(); v += stride) {
    gesture.add(v, linear * mesh.positions.row(v).transpose() + translation);
  }
  return gesture;
}

Gesture uneven(const Mesh& mesh, double by, int stride) {
  Gesture gesture;
  for (int v = 0; v < mesh.positions.rows(); v += stride) {
    gesture.add(
        v, mesh.positions.row(v).transpose() + by * Eigen::Vector3d(std::sin(v), std::cos(2 * v), std::sin(3 * v)));
  }
  return gesture;
}

}  // namespace swage::test
