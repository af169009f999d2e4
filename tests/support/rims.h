// Round rims of models, and how round an edit leaves them.
#pragma once

#include <vector>

#include "solids.h"

namespace swage::test {

/// Vertices on a circle about a line along an axis, all around it.
struct Rim {
  std::vector<int> vertices;
  int axis = 0;
};

/// Of those of a part that are farthest from the line through the middle of its box.
Rim rim_of(const Assembled& model, const Part& part, int axis);
/// Of each part whose name begins so.
std::vector<Rim> rims_of(const Assembled& model, const std::string& beginning, int axis);
/// Of bolted_plate(), along y.
std::vector<Rim> bolt_holes(const Assembled& plate);

/// By how much one axis of the ellipse that fits the rim best exceeds the other.
double oval(const Positions& positions, const Rim& rim);
/// The most over several.
double most_oval(const Positions& positions, const std::vector<Rim>& rims);
/// Extents across the axis, along the axis after it and the one after that.
Eigen::RowVector2d diameters(const Positions& positions, const Rim& rim);

}  // namespace swage::test
