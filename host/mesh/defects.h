// What keeps a mesh from being one closed manifold surface.
#pragma once

#include "adjacency.h"
#include "swage/diagnose.h"

namespace swage {

/// Those that name no vertex twice.
Triangles without_repeats(const Triangles& triangles);

/// Counts components, edges, loops and vertices of each kind. `triangles` name no vertex twice.
void count_defects(Diagnosis& diagnosis, const Triangles& triangles, const Edges& edges);

/// Counts what is there twice, and components where vertices at one place are one. `all` are all triangles of the mesh,
/// `proper` those of them that name no vertex twice.
void count_repeats(Diagnosis& diagnosis, const Positions& positions, const Triangles& all, const Triangles& proper);

}  // namespace swage
