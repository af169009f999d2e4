// CGAL's as-rigid-as-possible deformation, the formulation that Deform has: spokes and rims, cotangent weights, handles
// met exactly. One thread, all else CGAL's default.
#pragma once

#include <memory>

#include "swage/handles.h"
#include "swage/mesh.h"

namespace swage::bench {

class CgalArap {
 public:
  /// Prepares and factors.
  CgalArap(const Mesh& mesh, const Gesture& gesture);
  ~CgalArap();
  CgalArap(const CgalArap&) = delete;
  CgalArap& operator=(const CgalArap&) = delete;

  /// So many passes from the rest shape, all of them.
  void solve(int passes);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace swage::bench
