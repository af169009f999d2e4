// Points that a template is compared with a mesh at.
#pragma once

#include "surface_distance.h"
#include "swage/mesh.h"

namespace swage {

/// Evenly over the surface: as many on each stretch of area, at random places in their strata. The same however
/// the mesh is ordered.
Positions surface_samples(const Mesh& mesh, int count, unsigned seed);

struct VolumeSamples {
  Positions points;
  Eigen::VectorXd distances;
  std::vector<char> is_signed;
};

/// At random in 1.5 times the mesh's box, and a quarter of its diagonal about it at least.
VolumeSamples volume_samples(const Mesh& mesh, const SurfaceDistance& distance, int count, unsigned seed);

}  // namespace swage
