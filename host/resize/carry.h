// Points carried along by the grid that they lie in.
#pragma once

#include <memory>

#include "grid.h"
#include "swage/backend.h"
#include "swage/mesh.h"

namespace swage {

/// #V × 3: each vertex goes where the trilinear map of its cell takes it; those outside go as their nearest cell's map,
/// continued. `vertices`: the grid's, as Assembly places them, #(nx+1)(ny+1)(nz+1) × 3. Along an axis in which the box
/// has no extent vertices keep their distance from it. Throws InvalidInput.
Positions carry(const GridShape& shape, const AxisValues& vertices, const std::shared_ptr<const Mesh>& mesh,
                const Backend& backend);

/// The same of points, by the reference.
Positions carry(const GridShape& shape, const AxisValues& vertices, const PositionsRef& points);

}  // namespace swage
