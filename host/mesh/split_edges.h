// Finer triangles on the same surface.
#pragma once

#include "swage/mesh.h"

namespace swage {

/// Halves edges, and so the triangles beside them, the longest first, until none is longer or more triangles would be
/// more than `most`. Vertices that there are come first.
Mesh split_long_edges(const Mesh& mesh, double longest, Eigen::Index most);

}  // namespace swage
