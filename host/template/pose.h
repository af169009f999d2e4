// Where a mesh may lie in the space of its template.
#pragma once

#include <Eigen/Core>

#include "lattice.h"
#include "swage/template_fit.h"

namespace swage {

struct Box {
  Eigen::RowVector3d low, high;

  double diagonal() const { return (high - low).norm(); }
};

Box box_of(const Positions& points);

/// Of the zero set, to a cell in `resolution`; none where there is no surface.
std::optional<Box> box_of(const FieldAt& field, int resolution, const Poll& poll);

/// Brings one axis to another, 'x' to 'z', then turns by quarters about it.
Eigen::Matrix3d turn_of(char from, char to, int quarters);

/// Brings the box of the points to that of the template: by their diagonals and middles, and along up by their bottoms.
TemplatePose aligned(const Positions& points, const Box& box, char up, const Eigen::Matrix3d& rotation);

}  // namespace swage
