// Polygons into triangles.
#pragma once

#include <vector>

#include "swage/mesh.h"

namespace swage {

/// Appends the corners of the n - 2 triangles that cover the polygon, in its winding: a fan from its first corner
/// where that is right, else ears cut in the plane of its mean normal. False, with nothing appended, where ears would
/// have to be cut from more than `longest` corners.
bool triangulate(const std::vector<int>& polygon, const Positions& positions, size_t longest,
                 std::vector<int>& triangles);

/// Twice the area of a polygon times its unit normal (Newell).
Eigen::Vector3d area_vector(const std::vector<int>& polygon, const PositionsRef& positions);

}  // namespace swage
