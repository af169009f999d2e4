// What the steps' benchmarks work on.
#pragma once

#include "swage/steps.h"

namespace swage::bench {

/// A torus of as many triangles: 10'000, 100'000 or 1'000'000.
Mesh mesh_of(int triangles);

TransformStep::Rest reshape_rest(int triangles);

/// A torus of as many vertices, each with those within three edges.
CurvatureStep::Rest curvature_rest(int vertices);

}  // namespace swage::bench
