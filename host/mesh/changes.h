// What an edit changed.
#pragma once

#include <cstddef>
#include <optional>

#include "swage/compare.h"
#include "swage/handles.h"
#include "swage/mesh.h"

namespace swage {

/// #T: radians, [0, pi], between the normals of triangles before and after; NaN without area before or after.
Eigen::VectorXd normal_turns(const Positions& before, const Positions& after, const Triangles& triangles);

/// Triangles turned by more than a right angle.
int flipped(const Eigen::VectorXd& turns);

/// `weights` are areas or in proportion to them. NaN among the values counts for nothing.
Spread spread(const Eigen::VectorXd& values, const Eigen::VectorXd& weights);

/// The farthest that a handle is from its target, mesh units.
double largest_miss(const Gesture& gesture, const Positions& positions);

struct CrossingChange {
  int before = 0;  ///< Pairs of triangles that cross.
  int fresh = 0;   ///< That cross after, and not before.
};

/// None where more than `most_pairs` cross before or after.
std::optional<CrossingChange> crossing_change(const Positions& before, const Positions& after,
                                              const Triangles& triangles, std::size_t most_pairs);

}  // namespace swage
