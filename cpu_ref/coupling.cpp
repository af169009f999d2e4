// The transform step's matrix (paper eq. 35) times a vector, as the formulas read.
#include <Eigen/Geometry>

#include "cpu_steps.h"
#include "matrix_of_row.h"

namespace swage {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using RowMatrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

class CpuCoupling final : public CouplingStep {
 public:
  explicit CpuCoupling(const TransformStep::Rest& rest)
      : rest_(rest), pairs_of_triangles_(static_cast<size_t>(rest.triangles.rows())) {
    for (Eigen::Index p = 0; p < rest.pairs.rows(); ++p) {
      for (const int t : rest.pairs.row(p)) pairs_of_triangles_[static_cast<size_t>(t)].push_back(p);
    }
  }

  void apply(const Transforms& transforms, Transforms& product) override {
    check_rows("CouplingStep::apply", "transforms", transforms.rows(), rest_.triangles.rows());
    product.resize(transforms.rows(), 9);
#pragma omp parallel for schedule(static)
    for (Eigen::Index t = 0; t < transforms.rows(); ++t) {
      Eigen::Map<RowMatrix>(product.row(t).data()) = own(t, matrix(transforms, t)) + across_edges(t, transforms);
    }
  }

 private:
  /// Of eqs. 24, 26, 27 and 28.
  Matrix3d own(Eigen::Index t, const Matrix3d& transform) const {
    const Vector3d normal = rest_.normals.row(t);
    Matrix3d sum = rest_.regularizer_weight * transform;
    sum += rest_.normal_regularizer_weight * transform * normal * normal.transpose();
    for (const int e : rest_.triangle_edges.row(t)) {
      const Vector3d vector = rest_.edge_vectors.row(e), direction = vector.normalized();
      sum += transform * vector * vector.transpose() / rest_.mean_edge_length;
      sum += rest_.transform_normal_weight * normal.dot(transform * direction) * normal * direction.transpose();
    }
    if (rest_.sphericities[t] != 0) {
      sum += rest_.transform_sphericity_factor * rest_.sphericities[t] * corner_differences(t, transform);
    }
    return sum;
  }

  Matrix3d corner_differences(Eigen::Index t, const Matrix3d& transform) const {
    Matrix3d sum = Matrix3d::Zero();
    for (int i = 0; i < 3; ++i) {
      const Vector3d ij = toward(t, i, (i + 1) % 3), ik = toward(t, i, (i + 2) % 3);
      const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(ik, ij);
      const Vector3d difference = transform * ij - turn * (transform * ik);
      sum += difference * ij.transpose() - (turn.conjugate() * difference) * ik.transpose();
    }
    return sum;
  }

  Vector3d toward(Eigen::Index t, int from, int to) const {
    return (rest_.vertices.row(rest_.triangles(t, to)) - rest_.vertices.row(rest_.triangles(t, from))).normalized();
  }

  /// Of eq. 25 and its like along the opposites (E_similarity): what neighbours do differently to a direction.
  Matrix3d across_edges(Eigen::Index t, const Transforms& transforms) const {
    Matrix3d sum = Matrix3d::Zero();
    for (const Eigen::Index p : pairs_of_triangles_[static_cast<size_t>(t)]) {
      const Eigen::Index other = rest_.pairs(p, 0) == t ? rest_.pairs(p, 1) : rest_.pairs(p, 0);
      const Matrix3d difference = matrix(transforms, t) - matrix(transforms, other);
      const Vector3d direction = rest_.edge_vectors.row(rest_.pair_edges[p]).normalized();
      const Vector3d opposite = rest_.pair_opposites.row(p);
      sum += rest_.connect_weight * difference * direction * direction.transpose();
      sum += rest_.pair_similarities[p] * difference * opposite * opposite.transpose();
    }
    return sum;
  }

  TransformStep::Rest rest_;
  std::vector<std::vector<Eigen::Index>> pairs_of_triangles_;
};

}  // namespace

std::unique_ptr<CouplingStep> cpu_coupling(const TransformStep::Rest& rest) {
  return std::make_unique<CpuCoupling>(rest);
}

}  // namespace swage
