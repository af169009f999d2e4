// What vulnerable cells enclose.
#pragma once

#include "swage/protective_grid.h"

namespace swage {

/// Vulnerable cells around others in a slice of the grid, such as those of a wheel's tread, a dial's rim or a bolt
/// hole, keep their shape only together with these: they become wholly vulnerable along both axes of the slice. What
/// counts as vulnerable there is the less vulnerable of its two axes.
void protect_enclosed(const GridShape& shape, CellMap& map);

}  // namespace swage
