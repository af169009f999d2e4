// What stylizing did to a surface, in numbers: measures of the surface before, and of it after.
#pragma once

#include "swage/compare.h"
#include "swage/mesh.h"
#include "swage/style.h"

#pragma GCC visibility push(default)
namespace swage {

struct StyleMeasures {
  Spread angle;                 ///< Radians, [0, pi], between normals and targets, weighted by area.
  Eigen::VectorXd face_angles;  ///< #T: the same of triangles, of targets of vertices the mean of the corners'; NaN
                                ///< where there is no normal or no target.
  double developable = 0;       ///< Of the area around inner vertices the part where triangles' angles sum to 2 pi to
                                ///< 1e-3: there the surface unrolls without stretching. A vertex has a third of the
                                ///< areas around. 0 where there are none.
  double least_angle = 0;       ///< The smallest angle of all triangles, radians.
  double low_angle = 0;         ///< The 5th percentile of the triangles' smallest angles, radians.
  double quality = 0;  ///< Mean over triangles of 4 sqrt(3) area / (sum of squared sides): 1 where equilateral.
};

/// Targets are of any length, zero where there is none. Normals of vertices are means of the triangles' around,
/// weighted by area. Throws InvalidInput as check() does, and where targets are not one a vertex or triangle.
StyleMeasures style_measures(const PositionsRef& positions, const TrianglesRef& triangles, const GivenNormals& targets);

}  // namespace swage
#pragma GCC visibility pop
