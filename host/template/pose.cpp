#include "pose.h"

#include <Eigen/Geometry>
#include <numbers>

namespace swage {

using Eigen::RowVector3d;

Positions TemplatePose::into(const PositionsRef& positions) const {
  return (scale * (positions * rotation.transpose())).rowwise() + offset;
}

Positions TemplatePose::back(const PositionsRef& positions) const {
  return (positions.rowwise() - offset) * rotation / scale;
}

Box box_of(const Positions& points) { return {points.colwise().minCoeff(), points.colwise().maxCoeff()}; }

std::optional<Box> box_of(const FieldAt& field, int resolution, const Poll& poll) {
  const NearCells near = cells_near(field, resolution, poll);
  if (near.cells.empty() || near.touch_border()) return {};
  // The surface passes the outer cells somewhere: in their middles, by and large.
  const RowVector3d half = RowVector3d::Constant(near.lattice.width / 2);
  return Box{near.lattice.at(near.low) + half, near.lattice.at(near.high) + half};
}

Eigen::Matrix3d turn_of(char from, char to, int quarters) {
  const auto unit = [](char axis) -> Eigen::Vector3d { return Eigen::Vector3d::Unit(axis - 'x'); };
  const Eigen::Quaterniond up = Eigen::Quaterniond::FromTwoVectors(unit(from), unit(to));
  const Eigen::AngleAxisd about(quarters * std::numbers::pi / 2, unit(to));
  return about.toRotationMatrix() * up.toRotationMatrix();
}

TemplatePose aligned(const Positions& points, const Box& box, char up, const Eigen::Matrix3d& rotation) {
  TemplatePose pose;
  pose.rotation = rotation;
  const Box turned = box_of(Positions(points * rotation.transpose()));
  pose.scale = box.diagonal() / turned.diagonal();
  pose.offset = 0.5 * (box.low + box.high) - pose.scale * 0.5 * (turned.low + turned.high);
  const int u = up - 'x';
  pose.offset[u] = box.low[u] - pose.scale * turned.low[u];
  return pose;
}

}  // namespace swage
