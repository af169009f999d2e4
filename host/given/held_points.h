// Holds as the global step takes them.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "given.h"
#include "holds.h"
#include "laplacian_system.h"

namespace swage {

/// Without a `weight`, of |vertex - target|², vertices are where their holds want them, those of several in their
/// middle, and points within triangles very nearly.
HeldPoints held_points(const LaplacianSystem& system, const std::vector<Hold>& holds,
                       std::optional<double> weight = {});

/// The last one made where that is for the same points. Throws Unsolvable, naming the `caller` and a vertex as given,
/// where what is left to find is singular.
std::shared_ptr<const HeldLaplacian> held_laplacian(LastHeld& last, const LaplacianSystem& system,
                                                    const HeldPoints& points, const std::optional<Given>& given,
                                                    const char* caller);

}  // namespace swage
