// Maps of neighbourhoods by Eigen.
#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <cmath>

#include "cpu_steps.h"
#include "nearest_unit.h"
#include "procrustes.h"

namespace swage {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using RowMajor3d = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

constexpr double kStraight = 1e-9;  // Across a line whose edges spread less than this part, nothing is told.

Matrix3d across(const Vector3d& normal) { return Matrix3d::Identity() - normal * normal.transpose(); }

Matrix3d shortest_rotation(const Vector3d& from, const Vector3d& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to).toRotationMatrix();
}

class CpuLocalMap final : public LocalMapStep {
 public:
  explicit CpuLocalMap(const Rest& rest)
      : rest_(rest),
        turns_(std::isfinite(rest.guidance)),
        inverses_(element_count(rest.pairs), 9),
        unsmoothed_(turns_ ? inverses_.rows() : 0, 9),
        guides_(unsmoothed_.rows()) {
#pragma omp parallel for schedule(static)
    for (Eigen::Index i = 0; i < inverses_.rows(); ++i) {
      const Matrix3d spread = edge_covariance(rest_.pairs, rest_.pairs.vertices, i);
      const Matrix3d plane = across(rest_.pairs.normals.row(i).transpose());
      store(inverse_in(plane, spread + smoothing(i) * Matrix3d::Identity()), inverses_, i);
      if (!turns_) continue;
      store(inverse_in(plane, spread), unsmoothed_, i);
      guides_[i] = rest_.guidance * (plane * spread * plane).trace();
    }
  }

  void fit(const Positions& positions, const Positions& normals, Transforms& maps) override {
    const Eigen::Index count = inverses_.rows();
    check_rows("LocalMapStep::fit", "positions", positions.rows(), rest_.pairs.vertices.rows());
    check_rows("LocalMapStep::fit", "normals", normals.rows(), count);
    const bool smooths = !rest_.neighbours.empty();
    if (smooths) check_rows("LocalMapStep::fit", "maps", maps.rows(), count);
    const Transforms last = smooths ? maps : Transforms();
    const Positions turned = turns_ ? best_normals(positions, normals) : Positions();
    const Positions& now = turns_ ? turned : normals;
    maps.resize(count, 9);
#pragma omp parallel for schedule(static)
    for (Eigen::Index i = 0; i < count; ++i) {
      const Vector3d rest_normal = rest_.pairs.normals.row(i), normal = now.row(i);
      Matrix3d image = edge_covariance(rest_.pairs, positions, i);
      if (smooths) image += neighbours(i, now, last);
      store(normal * rest_normal.transpose() + across(normal) * image * matrix(inverses_, i), maps, i);
    }
  }

 private:
  /// What the maps leave is n'ᵀ (image inverse imageᵀ) n' - 2 n' . (image n + g m), and what does not depend on n'.
  Positions best_normals(const Positions& positions, const Positions& guides) const {
    Positions normals(guides.rows(), 3);
#pragma omp parallel for schedule(static)
    for (Eigen::Index i = 0; i < guides.rows(); ++i) {
      const Matrix3d image = edge_covariance(rest_.pairs, positions, i);
      const Vector3d guide = guides.row(i), rest_normal = rest_.pairs.normals.row(i);
      normals.row(i) =
          nearest_unit(image * matrix(unsmoothed_, i) * image.transpose(), image * rest_normal + guides_[i] * guide);
    }
    return normals;
  }

  static Eigen::Map<const RowMajor3d> matrix(const Transforms& rows, Eigen::Index i) {
    return Eigen::Map<const RowMajor3d>(rows.row(i).data());
  }

  /// sum_j w_j
  double smoothing(Eigen::Index i) const {
    if (rest_.neighbours.empty()) return 0;
    const auto at = static_cast<size_t>(i);
    return rest_.smoothing.segment(rest_.offsets[at], rest_.offsets[at + 1] - rest_.offsets[at]).sum();
  }

  /// (P spread P)⁺
  static Matrix3d inverse_in(const Matrix3d& plane, const Matrix3d& spread) {
    Eigen::JacobiSVD<Matrix3d> solver(plane * spread * plane, Eigen::ComputeFullU | Eigen::ComputeFullV);
    solver.setThreshold(kStraight);
    return solver.solve(plane);
  }

  /// sum_j w_j T_j
  Matrix3d neighbours(Eigen::Index i, const Positions& normals, const Transforms& last) const {
    Matrix3d sum = Matrix3d::Zero();
    const auto at = static_cast<size_t>(i);
    for (int k = rest_.offsets[at]; k < rest_.offsets[at + 1]; ++k) {
      const int j = rest_.neighbours[static_cast<size_t>(k)];
      sum += rest_.smoothing[k] * shortest_rotation(normals.row(j), normals.row(i)) * matrix(last, j) *
             shortest_rotation(rest_.pairs.normals.row(i), rest_.pairs.normals.row(j));
    }
    return sum;
  }

  Rest rest_;
  bool turns_;
  Transforms inverses_, unsmoothed_;  // (P (sum_p w_p a_p a_pᵀ + sum_j w_j I) P)⁺, and without neighbours.
  Eigen::VectorXd guides_;            // g
};

}  // namespace

std::unique_ptr<LocalMapStep> cpu_local_map(const LocalMapStep::Rest& rest) {
  return std::make_unique<CpuLocalMap>(rest);
}

}  // namespace swage
