// Finer triangles on the same surface.
#pragma once

#include "swage/mesh.h"

namespace swage {

/// Halves edges, and so the triangles beside them, until none is longer. Vertices that there are come first.
Mesh split_long_edges(const Mesh& mesh, double longest);

}  // namespace swage
