// The edges of a scaffold that join components.
#pragma once

#include <array>
#include <vector>

#include "swage/scaffold.h"

namespace swage {

/// Edges of tetrahedra whose ends belong to different components, first end below second, ascending: those to which the
/// paper adds weak terms. `component` is that of each surface vertex; the vertices after them, box corners and Steiner
/// points, are a component each, but edges between two of these are left out.
std::vector<std::array<int, 2>> scaffold_edges(const Tetrahedra& tetrahedra, const std::vector<int>& component);

}  // namespace swage
