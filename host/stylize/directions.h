// The nearest of many directions.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "box_tree.h"
#include "swage/mesh.h"

namespace swage {

/// Each row of length 1, but for those of length 0.
Positions normalised(Positions rows);

class Directions {
 public:
  /// #N × 3, of any length above 0; at least one.
  explicit Directions(const Positions& directions);
  Directions(const Directions&) = delete;
  Directions& operator=(const Directions&) = delete;

  /// The number of the one at the least angle to the unit vector; of several the lowest.
  int nearest(const Eigen::Vector3d& unit) const;
  /// Unit.
  Eigen::RowVector3d operator[](int i) const { return units_.row(i); }

 private:
  int nearest_of_few(const Eigen::Vector3d& unit) const;

  Positions units_;
  std::vector<Eigen::AlignedBox3d> boxes_;  // Of points, where there are many.
  std::optional<BoxTree> tree_;
};

}  // namespace swage
