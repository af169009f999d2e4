// Sphere maps.
#pragma once

#include "swage/style.h"

namespace swage::fuzz {

/// Requires directions and normals of length 1, and triangles of those.
void require_sphere(const SphereMap& map);

}  // namespace swage::fuzz
