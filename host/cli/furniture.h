// The demo's piece of furniture: a ladder-back chair, and an edit of it.
#pragma once

#include "swage/handles.h"
#include "swage/mesh.h"

namespace swage::cli {

/// A closed, connected, well-shaped mesh in metres: y up, the front towards z.
Mesh chair();

/// Feet, seat corners and post tips of chair(): apart in x and down in y, the feet on the floor.
Gesture wider_and_lower(const Mesh& chair);

}  // namespace swage::cli
