// CGAL's as-rigid-as-possible deformation, the formulation that Deform has: spokes and rims, cotangent weights, handles
// met exactly. One thread, all else CGAL's default: Eigen's SparseLU, polar decompositions. Its licence is the GPL:
// tests and benchmarks alone have it, never the library.
#pragma once

#include <memory>

#include "swage/handles.h"
#include "swage/mesh.h"

namespace swage::test {

class CgalArap {
 public:
  /// Weighs the edges and factors. Throws Unsolvable where CGAL takes the mesh for no manifold, as at a vertex that two
  /// fans of triangles share, or finds the system singular.
  CgalArap(const Mesh& mesh, const Gesture& gesture);
  ~CgalArap();
  CgalArap(const CgalArap&) = delete;
  CgalArap& operator=(const CgalArap&) = delete;

  /// So many passes from the rest shape, all of them.
  void solve(int passes);
  Positions positions() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace swage::test
