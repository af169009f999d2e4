// Stands in for host/external/remesher_cgal.cpp where the build leaves it out.
#include "remesher.h"
#include "swage/error.h"

namespace swage {

bool has_cgal() { return false; }

Mesh remeshed(const RemeshTask&, const HelperLimits&, const Poll&) {
  throw Unavailable("remesh: this build has no CGAL; configure with -DSWAGE_CGAL=ON");
}

}  // namespace swage
