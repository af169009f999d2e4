#include "element_normals.h"

#include <utility>

namespace swage {

Positions sums_around(const StylizePlan& plan, const Positions& of_triangles) {
  Positions sums(plan.mesh.positions.rows(), 3);
#pragma omp parallel for schedule(static)
  for (int v = 0; v < static_cast<int>(sums.rows()); ++v) {
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    for (const int t : plan.triangles_around[v]) sum += of_triangles.row(t);
    sums.row(v) = sum;
  }
  return sums;
}

Positions element_normals(const StylizePlan& plan, const Positions& positions) {
  Positions normals = area_vectors(positions, plan.mesh.triangles);
  if (!plan.of_triangles()) normals = sums_around(plan, normals);
  return normalised(std::move(normals));
}

}  // namespace swage
