// Of triangles that are no surface the surface around them.
#include <CGAL/alpha_wrap_3.h>

#include "surface.h"

namespace swage {

Surface wrapped(const Soup& soup, double alpha, double offset) {
  Surface surface;
  CGAL::alpha_wrap_3(soup.points, soup.triangles, alpha, offset, surface);
  return surface;
}

}  // namespace swage
