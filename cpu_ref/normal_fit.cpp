// Principal directions of the normals around vertices by Eigen.
#include <Eigen/Eigenvalues>

#include "cpu_steps.h"

namespace swage {
namespace {

using Eigen::Matrix3d;

class CpuNormalFit final : public NormalFitStep {
 public:
  explicit CpuNormalFit(const Rest& rest) : rest_(rest) {}

  void fit(const Positions& area_vectors, Transforms& directions, Positions& spreads) override {
    check_rows("NormalFitStep::fit", "area_vectors", area_vectors.rows(), rest_.triangle_count);
    const auto count = static_cast<Eigen::Index>(rest_.offsets.size()) - 1;
    directions.resize(count, 9);
    spreads.resize(count, 3);
#pragma omp parallel for schedule(static)
    for (Eigen::Index v = 0; v < count; ++v) {
      const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(moment(area_vectors, static_cast<size_t>(v)));
      Eigen::Map<Matrix3d>(directions.row(v).data()) = solver.eigenvectors();  // By columns: a direction each.
      spreads.row(v) = solver.eigenvalues();
    }
  }

 private:
  Matrix3d moment(const Positions& area_vectors, size_t v) const {
    Matrix3d sum = Matrix3d::Zero();
    for (int i = rest_.offsets[v]; i < rest_.offsets[v + 1]; ++i) {
      const Eigen::RowVector3d twice = area_vectors.row(rest_.triangles[static_cast<size_t>(i)]);
      const Eigen::RowVector3d normal = twice.stableNormalized();
      sum += twice.stableNorm() / 2 * normal.transpose() * normal;
    }
    return sum;
  }

  Rest rest_;
};

}  // namespace

std::unique_ptr<NormalFitStep> cpu_normal_fit(const NormalFitStep::Rest& rest) {
  return std::make_unique<CpuNormalFit>(rest);
}

}  // namespace swage
