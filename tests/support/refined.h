// What a subdivided mesh inherits.
#pragma once

#include "swage/reshape.h"

namespace swage::test {

/// Curvatures and straight chains for the mesh that subdivided() makes of a coarse one.
ReshapeOptions refined(ReshapeOptions options, const Triangles& coarse, const Triangles& fine);

}  // namespace swage::test
