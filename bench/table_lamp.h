// A lamp, a solid of revolution, and an edit of it.
#pragma once

#include "swage/handles.h"
#include "swage/mesh.h"

namespace swage::bench {

/// A closed mesh in metres, y up: a round base, a pole and a conical shade.
Mesh table_lamp();

/// Base held, shade lifted by two points of its rim.
Gesture taller(const Mesh& lamp);

}  // namespace swage::bench
