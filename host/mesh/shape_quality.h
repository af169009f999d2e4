// How well triangles are shaped, and whether that suits reshaping: "sufficiently fine connected triangle meshes, with
// well-shaped triangles and roughly uniform mesh density" (Araújo et al. 2023, section 5).
#pragma once

#include "swage/mesh.h"

namespace swage {

struct ShapeQuality {
  int triangles = 0;
  double sharp_area = 1;          ///< Share of the area in triangles with an angle below 10 degrees.
  double least_angle = 0;         ///< Of all, radians.
  double low_angle = 0;           ///< 5th percentile of the triangles' smallest angles, radians.
  double mean = 0;                ///< Of 4 sqrt(3) area / (sum of squared sides): 1 where equilateral.
  double longest_over_mean = 1;   ///< Edge lengths, each edge once a triangle.
  double mean_over_diagonal = 1;  ///< Edge length over the diagonal of the triangles' box.
};

/// Triangles without area count as of angle 0. Without triangles, as the struct stands.
ShapeQuality shape_quality(const Positions& positions, const Triangles& triangles);

/// One triangle in twenty has an angle below 10 degrees, or a tenth of the area lies in such.
bool has_needles(const ShapeQuality& quality);
/// An edge is more than 8 times as long as the mean.
bool is_uneven(const ShapeQuality& quality);
/// The mean edge is above 0.08 of the diagonal.
bool is_coarse(const ShapeQuality& quality);

/// Whether a mesh is to be remeshed before it is reshaped: it has needles, or is uneven or coarse. So are all 68 real
/// models known for bad shape, and 2 of 50 known for good.
bool badly_shaped(const ShapeQuality& quality);

}  // namespace swage
