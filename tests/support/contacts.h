// Where parts of a model touch.
#pragma once

#include <utility>
#include <vector>

#include "solids.h"

namespace swage::test {

/// Pairs of vertices of different parts at one place.
std::vector<std::pair<int, int>> vertices_met(const Assembled& model);

}  // namespace swage::test
