// Stands in for host/external/tetrahedra_tetgen.cpp where the build leaves it out.
#include "swage/error.h"
#include "tetrahedra.h"

namespace swage {

bool has_tetgen() { return false; }

Filling tetrahedra_of(const Complex&, bool, const HelperLimits&, const Poll&) {
  throw Unavailable("scaffold: this build has no TetGen; configure with -DSWAGE_TETGEN=ON");
}

}  // namespace swage
