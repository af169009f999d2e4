// What a report says of any mesh and handles.
#pragma once

#include "adjacency.h"
#include "surface.h"
#include "swage/handles.h"
#include "swage/report.h"

namespace swage {

struct SurfaceFacts {
  const SurfaceCounts& counts;
  const Edges& edges;
  int flat_triangles = 0, components = 1;
};

/// What of a mesh is not as of one well-made surface.
void warn_of_shape(const SurfaceFacts& facts, Report& report);

/// Handles that are not where they were asked to, and why and what to do.
void warn_of_misses(const Mesh& mesh, const Gesture& gesture, const Positions& positions, const char* why,
                    Report& report);

}  // namespace swage
