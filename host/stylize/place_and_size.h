// Where components are, and how large.
#pragma once

#include <vector>

#include "plan.h"

namespace swage {

struct PlaceAndSize {
  double area = 0;
  Eigen::RowVector3d centre = Eigen::RowVector3d::Zero();  ///< Of the area.
  double spread = 0;                                       ///< Root of its mean square distance from the centre.
};

/// Of each component.
std::vector<PlaceAndSize> places_and_sizes(const StylizePlan& plan, const Positions& positions);

/// Moves and scales each component as it was, but for those held.
void restore(const StylizePlan& plan, const std::vector<PlaceAndSize>& as_it_was, const std::vector<char>& is_held,
             Positions& positions);

}  // namespace swage
