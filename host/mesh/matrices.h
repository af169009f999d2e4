// Matrices of triangles and other elements, a row each.
#pragma once

#include "swage/steps.h"

namespace swage {

/// #N × 9 identity matrices.
inline Transforms identities(Eigen::Index count) {
  Transforms matrices = Transforms::Zero(count, 9);
  matrices(Eigen::all, {0, 4, 8}).setOnes();
  return matrices;
}

}  // namespace swage
