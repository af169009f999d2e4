// The corners that the sphericity term compares (eqs. 17 and 18).
#pragma once

#include <array>

#include "swage/steps.h"

namespace swage {

struct Corner {
  int i, j, k;                         ///< Vertices: the corner's own and the two it sees.
  Eigen::Vector3d toward_j, toward_k;  ///< Unit, at rest.
  double length_j, length_k;           ///< Of the rest edges.
  Eigen::Matrix3d turn;                ///< About the triangle's normal at rest, `toward_k` into `toward_j`.
};

/// Directions come from the rest's vertices, lengths from its edge vectors: finalising replaces the latter only.
std::array<Corner, 3> corners(const TransformStep::Rest& rest, Eigen::Index triangle);

}  // namespace swage
