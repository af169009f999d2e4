// Closest rotations by singular values (Kabsch 1976; Umeyama 1991).
#include <Eigen/LU>
#include <Eigen/SVD>

#include "cpu_steps.h"
#include "procrustes.h"

namespace swage {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d edge_covariance(const PairsRest& rest, const Positions& positions, Eigen::Index element) {
  const auto at = static_cast<size_t>(element);
  Matrix3d sum = Matrix3d::Zero();
  for (int p = rest.offsets[at]; p < rest.offsets[at + 1]; ++p) {
    const int first = rest.pairs(p, 0), second = rest.pairs(p, 1);
    const Vector3d before = rest.vertices.row(second) - rest.vertices.row(first);
    const Vector3d now = positions.row(second) - positions.row(first);
    sum += rest.weights[p] * now * before.transpose();
  }
  return sum;
}

Matrix3d normal_covariance(const PairsRest& rest, const Positions& targets, Eigen::Index element) {
  if (rest.normals.rows() == 0) return Matrix3d::Zero();
  return rest.normal_weights[element] * targets.row(element).transpose() * rest.normals.row(element);
}

Matrix3d closest_rotation(const Matrix3d& covariance) {
  const double largest = covariance.cwiseAbs().maxCoeff();
  if (largest == 0) return Matrix3d::Identity();
  const Eigen::JacobiSVD<Matrix3d> svd(covariance / largest, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Matrix3d& U = svd.matrixU();
  const Matrix3d& V = svd.matrixV();
  const double side = (U * V.transpose()).determinant() < 0 ? -1 : 1;
  return U * Vector3d(1, 1, side).asDiagonal() * V.transpose();
}

namespace {

class CpuRotation final : public RotationStep {
 public:
  explicit CpuRotation(const PairsRest& rest) : rest_(rest) {}

  void fit(const Positions& positions, const Positions& targets, Transforms& rotations) override {
    check_rows("RotationStep::fit", "positions", positions.rows(), rest_.vertices.rows());
    check_rows("RotationStep::fit", "targets", targets.rows(), rest_.normals.rows());
    const Eigen::Index count = element_count(rest_);
    rotations.resize(count, 9);
#pragma omp parallel for schedule(static)
    for (Eigen::Index i = 0; i < count; ++i) {
      const Matrix3d covariance = edge_covariance(rest_, positions, i) + normal_covariance(rest_, targets, i);
      store(closest_rotation(covariance), rotations, i);
    }
  }

 private:
  PairsRest rest_;
};

}  // namespace

std::unique_ptr<RotationStep> cpu_rotation(const PairsRest& rest) { return std::make_unique<CpuRotation>(rest); }

}  // namespace swage
