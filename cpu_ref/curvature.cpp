// Principal curvatures of the quadric z = a x² + b x y + c y² + d x + e y over a vertex's tangent plane that fits its
// neighbours best (Goldfeather and Interrante 2004).
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <cmath>
#include <numbers>

#include "cpu_steps.h"
#include "swage/thrown.h"

namespace swage {
namespace {

constexpr int kCoefficients = 5;
// Neighbours whose spread across a line is below this part of their distance lie on the line, seen along the normal.
constexpr double kLine = 1e-4;
// Singular values below this part of the largest are 0: six-digit coordinates make some 1e-5 of nothing. Where
// every coefficient can be told, the smallest is usually a tenth.
constexpr double kRankTolerance = 1e-3;

/// The gradient and the second derivatives of a height at the vertex.
struct Quadric {
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  Eigen::Matrix2d hessian = Eigen::Matrix2d::Zero();
};

/// The quadric over the plane that fits best; the flattest such where one coefficient can't be told, as that between
/// the two ends of a tube without rings; flat where more than one can't.
Quadric fit_quadric(const Eigen::MatrixX2d& places, const Eigen::VectorXd& heights) {
  const Eigen::ArrayXd x = places.col(0), y = places.col(1);
  Eigen::MatrixXd terms(places.rows(), kCoefficients);
  // With the root, no turn of the axes changes how flat a quadric counts.
  terms << x * x, std::numbers::sqrt2 * x * y, y * y, x, y;
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(terms, Eigen::ComputeThinU | Eigen::ComputeThinV);
  svd.setThreshold(kRankTolerance);
  if (svd.rank() < kCoefficients - 1) return {};
  const Eigen::VectorXd c = svd.solve(heights);
  Quadric quadric;
  quadric.gradient << c[3], c[4];
  quadric.hessian << 2 * c[0], std::numbers::sqrt2 * c[1], std::numbers::sqrt2 * c[1], 2 * c[2];
  return quadric;
}

/// The same with lengths measured along the axes in which the places spread most and least, in units of those spreads.
Quadric fit_in_own_units(const Eigen::MatrixX2d& places, const Eigen::VectorXd& heights) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(Eigen::Matrix2d(places.transpose() * places));
  const Eigen::Vector2d spreads = axes.eigenvalues().cwiseMax(0).cwiseSqrt();
  if (!(spreads[0] > kLine * std::hypot(places.norm(), heights.norm()))) return {};
  const Eigen::Matrix2d to_units = axes.eigenvectors() * spreads.cwiseInverse().asDiagonal();
  const Quadric quadric = fit_quadric(places * to_units, heights);
  return {to_units * quadric.gradient, to_units * quadric.hessian * to_units.transpose()};
}

struct Principal {
  Eigen::RowVector2d curvatures = Eigen::RowVector2d::Zero();
  Eigen::RowVector3d direction = Eigen::RowVector3d::Zero();  ///< Of the first.
};

/// From the first and second fundamental forms of the graph over a plane, whose normal points up: a hill curves
/// positively.
Principal principal_of(const Quadric& quadric, const Eigen::Matrix<double, 3, 2>& plane, const Eigen::Vector3d& up) {
  const Eigen::Matrix2d first = Eigen::Matrix2d::Identity() + quadric.gradient * quadric.gradient.transpose();
  const Eigen::Matrix2d second = quadric.hessian / std::sqrt(1 + quadric.gradient.squaredNorm());
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d> shape(second, first);
  const Eigen::Vector2d along = shape.eigenvectors().col(0);
  return {-shape.eigenvalues().transpose(), (plane * along + quadric.gradient.dot(along) * up).normalized()};
}

Principal principal_at(const CurvatureStep::Rest& rest, int v) {
  const auto at = static_cast<size_t>(v);
  const int first = rest.offsets[at], count = rest.offsets[at + 1] - first;
  if (count < kCoefficients) return {};

  const Eigen::Vector3d normal = rest.normals.row(v);
  Eigen::Matrix<double, 3, 2> plane;
  plane.col(0) = normal.unitOrthogonal();
  plane.col(1) = normal.cross(plane.col(0));
  const Eigen::Map<const Eigen::VectorXi> neighbours(rest.neighbours.data() + first, count);
  const Positions offsets = rest.positions(neighbours, Eigen::all).rowwise() - rest.positions.row(v);
  return principal_of(fit_in_own_units(offsets * plane, offsets * normal), plane, normal);
}

class CpuCurvature final : public CurvatureStep {
 public:
  explicit CpuCurvature(const Rest& rest) : rest_(rest) {}

  void fit(Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>& curvatures) override {
    Positions directions;
    fit(curvatures, directions);
  }

  void fit(Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>& curvatures, Positions& directions) override {
    const int count = static_cast<int>(rest_.positions.rows());
    curvatures.resize(count, 2);
    directions.resize(count, 3);
    Thrown thrown;
#pragma omp parallel for schedule(dynamic, 256)
    for (int v = 0; v < count; ++v) {
      thrown.keep([&] {
        const Principal principal = principal_at(rest_, v);
        curvatures.row(v) = principal.curvatures;
        directions.row(v) = principal.direction;
      });
    }
    thrown.rethrow();
  }

 private:
  Rest rest_;
};

}  // namespace

std::unique_ptr<CurvatureStep> cpu_curvature(const CurvatureStep::Rest& rest) {
  return std::make_unique<CpuCurvature>(rest);
}

}  // namespace swage
