// Both parts of the objective.
#include <algorithm>

#include "plan.h"

namespace swage {

StylizeTerms energy(const StylizePlan& plan, const Positions& positions, const Positions& targets,
                    const StylizeFit& fitted) {
  const PairsRest& rest = plan.elements.pairs;
  Eigen::VectorXd of_normals = Eigen::VectorXd::Zero(rest.normals.rows());
#pragma omp parallel for schedule(static)
  for (Eigen::Index n = 0; n < of_normals.size(); ++n) {
    // Where the scale is 0, any rotation is as good: the one that meets the target.
    if (fitted.scales[n] == 0 || targets.row(n).isZero(0)) continue;
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> matrix(fitted.matrices.row(n).data());
    const Eigen::RowVector3d turned = rest.normals.row(n) * matrix.transpose() / fitted.scales[n];
    of_normals[n] = rest.normal_weights[n] * (turned - targets.row(n)).squaredNorm();
  }
  return {edge_energy(rest, positions, fitted.matrices), of_normals.sum()};
}

}  // namespace swage
