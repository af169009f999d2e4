// Isotropic remeshing and wrapping, whoever does it.
#pragma once

#include "helper_process.h"
#include "swage/mesh.h"

namespace swage {

struct RemeshTask {
  Mesh mesh;  ///< Welded.
  double edge_length = 0, feature_angle = 0;
  double wrap_alpha = 0;  ///< Length; 0 for no envelope.
  int iterations = 0;
  int triangle_limit = 0;  ///< About.
};

/// Whether this build has CGAL, without which remeshed throws Unavailable.
bool has_cgal();

/// Vertices may be at one place, and triangles without area. Throws as run_helper does. What comes back is as the
/// helper says, and not looked at.
Mesh remeshed(const RemeshTask& task, const HelperLimits& limits, const Poll& poll);

}  // namespace swage
