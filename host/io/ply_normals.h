// The normals that a PLY file has.
#pragma once

#include "input.h"
#include "swage/mesh.h"

namespace swage {

/// A row each; without rows where they have none.
struct PlyNormals {
  Positions vertices;
  Positions faces;  ///< Those of fewer than three vertices left out, as read_mesh() does.
};

PlyNormals read_ply_normals(Input& input);

}  // namespace swage
