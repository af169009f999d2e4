// Holds as the global step takes them.
#pragma once

#include <optional>
#include <vector>

#include "holds.h"
#include "laplacian_system.h"

namespace swage {

/// Without a `weight`, of |vertex - target|², vertices are where their holds want them, those of several in their
/// middle, and points within triangles very nearly.
HeldPoints held_points(const LaplacianSystem& system, const std::vector<Hold>& holds,
                       std::optional<double> weight = {});

}  // namespace swage
