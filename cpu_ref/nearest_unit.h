// The nearest of unit vectors.
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace swage {

/// The unit vector n that makes nᵀ H n - 2 b · n the least, of a symmetric H that is not negative: (H + t) n = b with
/// t above minus the least eigenvalue. Newton's steps for 1 / |n| = 1, which is concave in t, come from below.
inline Eigen::Vector3d nearest_unit(const Eigen::Matrix3d& h, const Eigen::Vector3d& b) {
  constexpr int kSteps = 50;
  constexpr double kNear = 1e-14, kLeast = 1e-12;  // Parts of H and b: none is nearer to an eigenvalue.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(h);
  const Eigen::Array3d values = eigen.eigenvalues(), along = eigen.eigenvectors().transpose() * b;
  const double size = values.abs().maxCoeff() + b.norm();
  double t = (along.abs() - values).maxCoeff();
  t = std::max(t, kLeast * size - values[0]);
  for (int i = 0; i < kSteps; ++i) {
    const Eigen::Array3d n = along / (values + t);
    const double square = n.square().sum(), slope = (n.square() / (values + t)).sum();
    const double step = square * (std::sqrt(square) - 1) / slope;
    if (!(step > kNear * size)) break;
    t += step;
  }
  return (eigen.eigenvectors() * (along / (values + t)).matrix()).stableNormalized();
}

}  // namespace swage
