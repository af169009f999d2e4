// Signed distances from a mesh.
//
// Bærentzen, Aanæs: Signed Distance Computation Using the Angle Weighted Pseudonormal. IEEE Transactions on
// Visualization and Computer Graphics 11(3), 2005.
#pragma once

#include <vector>

#include "adjacency.h"
#include "rays_embree.h"
#include "swage/mesh.h"

namespace swage {

/// Of a mesh in the unit box, whose closed parts are outwards however they are wound. Threads may share it.
class SurfaceDistance {
 public:
  explicit SurfaceDistance(Mesh mesh);

  struct Found {
    double distance;  ///< Negative inside.
    bool is_signed;   ///< Whether what is nearest belongs to a closed part; the distance is positive elsewhere.
  };
  Found operator()(const Eigen::RowVector3d& point) const;

  /// The part of the area that belongs to closed parts.
  double closed_area() const { return closed_area_; }

 private:
  void find_closed_parts();
  Eigen::Vector3d pseudonormal(int triangle, const Eigen::Vector3d& barycentric) const;

  Mesh mesh_;
  Edges edges_;
  RayScene scene_;
  Positions normals_, edge_normals_, vertex_normals_;
  std::vector<char> is_closed_;  // Of each triangle.
  double closed_area_ = 0;
};

}  // namespace swage
