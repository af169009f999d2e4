#include "plan.h"

namespace swage {

double edge_energy(const PairsRest& pairs, const Positions& positions, const Transforms& matrices) {
  Eigen::VectorXd of_element = Eigen::VectorXd::Zero(matrices.rows());
#pragma omp parallel for schedule(static)
  for (Eigen::Index n = 0; n < matrices.rows(); ++n) {
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> matrix(matrices.row(n).data());
    const auto at = static_cast<size_t>(n);
    for (int p = pairs.offsets[at]; p < pairs.offsets[at + 1]; ++p) {
      const int i = pairs.pairs(p, 0), j = pairs.pairs(p, 1);
      const Eigen::RowVector3d rest = pairs.vertices.row(j) - pairs.vertices.row(i);
      const Eigen::RowVector3d now = positions.row(j) - positions.row(i);
      of_element[n] += pairs.weights[p] * (now - rest * matrix.transpose()).squaredNorm();
    }
  }
  return of_element.sum();
}

double hold_energy(const DeformOptions& options, const std::vector<Hold>& holds, const Positions& positions) {
  if (!options.handle_weight) return 0;
  double sum = 0;
  for (const Hold& hold : holds) {
    sum += hold.share * *options.handle_weight * (hold.point(positions) - hold.target).squaredNorm();
  }
  return sum;
}

}  // namespace swage
