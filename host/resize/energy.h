// What a resizing minimises, term by term.
#pragma once

#include <map>
#include <string>

#include "grid.h"
#include "swage/resize.h"

namespace swage {

/// Of the scales "modulation", "compatibility" and, where size is kept, "size"; of the vertices, in units of cells at
/// rest, "scale" and "orthogonality".
std::map<std::string, double> energy_by_term(const GridShape& shape, const CellMap& map, const ResizeTarget& target,
                                             const AxisValues& scales, const AxisValues& vertices);

}  // namespace swage
