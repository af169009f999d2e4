// The quadric fit's shared maths as C++, in single and double precision, against Eigen; and the device against the same
// C++, bit for bit.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "opencl_device.h"
#include "swage/steps.h"

namespace swage {
namespace {

// Each needs those before it.
// clang-format off
namespace in_single {
using real = float;
using mask = int;
using std::copysign, std::fabs, std::sqrt;
#include "shared/vec3.h"
#include "shared/quadric.h"
}  // namespace in_single
namespace in_double {
using real = double;
using mask = int;
using std::copysign, std::fabs, std::sqrt;
#include "shared/vec3.h"
#include "shared/quadric.h"
}  // namespace in_double
// clang-format on

using Eigen::Matrix2d, Eigen::MatrixXd, Eigen::Vector2d, Eigen::Vector3d;
using Matrix5d = Eigen::Matrix<double, 5, 5>;
using Vector5d = Eigen::Vector<double, 5>;
using Equations = Eigen::Matrix<double, Eigen::Dynamic, 6>;  // Five terms and the right-hand side.

struct Single {
  using real = float;
  using Vec3 = in_single::Vec3;
  using Spread = in_single::Spread;
  using Terms = in_single::Terms;
  using Triangle = in_single::Triangle;
  using Rows = in_single::Rows;
  static Spread no_spread() { return in_single::no_spread(); }
  static Triangle no_equations() { return in_single::no_equations(); }
  static constexpr double kRounding = 1e-6, kUnswept = 1e-5;
  static constexpr Precision kPrecision = Precision::single;
};

struct Twice {
  using real = double;
  using Vec3 = in_double::Vec3;
  using Spread = in_double::Spread;
  using Terms = in_double::Terms;
  using Triangle = in_double::Triangle;
  using Rows = in_double::Rows;
  static Spread no_spread() { return in_double::no_spread(); }
  static Triangle no_equations() { return in_double::no_equations(); }
  static constexpr double kRounding = 2e-15, kUnswept = 1e-12;  // What the sweeps leave.
  static constexpr Precision kPrecision = Precision::twice;
};

/// Random numbers and matrices.
class Source {
 public:
  double number() { return normal_(random_); }
  MatrixXd gaussian(int rows, int columns) {
    return MatrixXd::NullaryExpr(rows, columns, [&] { return number(); });
  }
  Matrix5d orthogonal() { return Eigen::HouseholderQR<Matrix5d>(gaussian(5, 5)).householderQ(); }
  Matrix5d with(const Vector5d& values) { return orthogonal() * values.asDiagonal() * orthogonal(); }
  /// Between low and 1, as often in each decade.
  double size(double low) { return std::pow(low, std::uniform_real_distribution<double>(0, 1)(random_)); }

 private:
  std::mt19937_64 random_{7};
  std::normal_distribution<double> normal_;
};

/// As the type sees them.
template <typename As>
MatrixXd rounded(const MatrixXd& m) {
  return m.cast<typename As::real>().template cast<double>();
}

template <typename As>
typename As::Terms equation(const Eigen::RowVectorXd& numbers) {
  const Eigen::RowVector<typename As::real, 6> n = numbers.cast<typename As::real>();
  return {n[0], n[1], n[2], n[3], n[4], n[5]};
}

template <typename As>
typename As::Rows folded(const MatrixXd& equations) {
  typename As::Triangle triangle = As::no_equations();
  for (const auto& row : equations.rowwise()) triangle = fold(triangle, equation<As>(row));
  return rows_of(triangle);
}

template <typename Terms>
Eigen::RowVector<double, 6> numbers(const Terms& t) {
  return {t.xx, t.xy, t.yy, t.x, t.y, t.z};
}

template <typename Rows>
Eigen::Matrix<double, 5, 6> matrix(const Rows& r) {
  Eigen::Matrix<double, 5, 6> m;
  m << numbers(r.a), numbers(r.b), numbers(r.c), numbers(r.d), numbers(r.e);
  return m;
}

template <typename As>
class QuadricFit : public testing::Test {};

using Arithmetics = testing::Types<Single, Twice>;
TYPED_TEST_SUITE(QuadricFit, Arithmetics);

TYPED_TEST(QuadricFit, FoldsEquationsIntoATriangleOfTheSameNormalEquations) {
  Source source;
  for (int trial = 0; trial < 2000; ++trial) {
    MatrixXd equations = source.gaussian(trial % 40, 6);
    if (trial % 3 == 1) equations.col(trial % 5).setZero();
    if (trial % 3 == 2) equations.col(trial % 5) = equations.col((trial + 1) % 5);
    for (auto row : equations.rowwise()) row *= trial % 2 == 0 ? 1 : source.size(1e-6);
    equations = rounded<TypeParam>(equations);
    const Eigen::Matrix<double, 5, 6> R = matrix(folded<TypeParam>(equations));
    EXPECT_TRUE(R.leftCols<5>().isUpperTriangular(0));
    const MatrixXd expected = equations.leftCols<5>().transpose() * equations;
    ASSERT_LE((R.leftCols<5>().transpose() * R - expected).norm(),
              10 * TypeParam::kRounding * equations.squaredNorm() + 1e-25)
        << "trial " << trial;
  }
}

struct Kind {
  std::string name;
  std::function<Matrix5d(Source&)> draw;
};

std::vector<Kind> kinds() {
  return {
      {"gaussian", [](Source& s) { return s.with(s.gaussian(5, 1).cwiseAbs().cwiseMax(0.01)); }},
      {"graded",
       [](Source& s) {
         return s.with({1, 0.3, 0.1, 0.03, 0.01});
       }},
      {"equal",
       [](Source& s) {
         return s.with({1, 1, 1, 1, 1});
       }},
      {"equal in groups",
       [](Source& s) {
         return s.with({1, 1, 0.1, 0.1, 0.1});
       }},
      {"rank four",
       [](Source& s) {
         return s.with({1, 0.5, 0.2, 0.1, 0});
       }},
      {"nearly rank four",
       [](Source& s) {
         return s.with({1, 0.5, 0.2, 0.1, 1e-4});
       }},
      {"rank three",
       [](Source& s) {
         return s.with({1, 0.5, 0.1, 0, 0});
       }},
      {"rank one",
       [](Source& s) {
         return s.with({1, 0, 0, 0, 0});
       }},
      {"nothing", [](Source&) { return Matrix5d(Matrix5d::Zero()); }},
      {"diagonal", [](Source& s) { return Matrix5d(Vector5d(0.1 + s.size(0.01), 1, 0.1, 0.4, 1).asDiagonal()); }},
  };
}

TYPED_TEST(QuadricFit, SolvesByTheSingularValuesThatCount) {
  for (const Kind& kind : kinds()) {
    Source source;
    double worst = 0;
    for (int trial = 0; trial < 20'000; ++trial) {
      // As a triangle, which the step begins with.
      const Matrix5d drawn = kind.draw(source);
      const Eigen::Matrix<double, 5, 6> drawn_with_side =
          (Eigen::Matrix<double, 5, 6>() << drawn, source.gaussian(5, 1)).finished();
      const auto rows = folded<TypeParam>(rounded<TypeParam>(drawn_with_side));
      const Eigen::Matrix<double, 5, 6> m = matrix(rows);
      Eigen::JacobiSVD<Matrix5d> svd(m.leftCols<5>(), Eigen::ComputeFullU | Eigen::ComputeFullV);
      svd.setThreshold(1e-3);
      Vector5d expected = Vector5d::Zero();
      if (svd.rank() >= 4) expected = svd.solve(m.col(5));
      const Vector5d found =
          numbers(coefficients(orthogonal(rows, sizeof(typename TypeParam::real)))).template head<5>();
      ASSERT_TRUE(found.allFinite()) << kind.name;
      // How far rounding carries a coefficient.
      const double least = svd.rank() == 0 ? 1 : svd.singularValues()[svd.rank() - 1];
      const double sensitivity = m.col(5).norm() * std::max(svd.singularValues()[0], 1e-30) / (least * least);
      worst = std::max(worst, (found - expected).norm() / sensitivity);
    }
    EXPECT_LT(worst, TypeParam::kUnswept) << kind.name;
  }
}

TYPED_TEST(QuadricFit, MeasuresSpreadsAlongThePrincipalAxes) {
  using real = typename TypeParam::real;
  Source source;
  for (int trial = 0; trial < 2000; ++trial) {
    const double thin = source.size(1e-3);
    const Matrix2d turn = Eigen::Rotation2Dd(source.number()).toRotationMatrix();
    MatrixXd places(5 + trial % 30, 3);
    places << source.gaussian(static_cast<int>(places.rows()), 2) * Vector2d(1, thin).asDiagonal() * turn,
        source.gaussian(static_cast<int>(places.rows()), 1);
    places = rounded<TypeParam>(places);
    const typename TypeParam::Vec3 normal{0, 0, 1};
    const auto plane = plane_normal_to(normal);
    typename TypeParam::Spread spread = TypeParam::no_spread();
    for (const auto& p : places.rowwise()) {
      spread =
          spread_to(spread, plane, normal, {static_cast<real>(p[0]), static_cast<real>(p[1]), static_cast<real>(p[2])});
    }
    const auto units = units_of(spread, plane);
    MatrixXd to_units(2, 2);
    to_units << units.axes.u.x, units.axes.w.x, units.axes.u.y, units.axes.w.y;
    const MatrixXd in_units = places.leftCols(2) * to_units;
    // Both axes are principal, and as long as the places spread.
    ASSERT_LT((in_units.transpose() * in_units - Matrix2d::Identity()).norm(), 20 * TypeParam::kRounding / thin);
    ASSERT_NEAR(to_units.col(0).norm(), units.per_u, 10 * TypeParam::kRounding * units.per_u);
    ASSERT_NEAR(to_units.col(1).norm(), units.per_w, 10 * TypeParam::kRounding * units.per_w);
  }
}

TYPED_TEST(QuadricFit, HasTheCurvaturesOfItsGraph) {
  using real = typename TypeParam::real;
  Source source;
  for (int trial = 0; trial < 20'000; ++trial) {
    MatrixXd c = source.gaussian(1, 6);
    if (trial % 4 == 1) c.rightCols<3>() *= 100;  // Steep.
    if (trial % 4 == 2) c.leftCols<3>() << 1, 0, 1;
    if (trial % 4 == 3) c.setZero();
    const Vector2d per = rounded<TypeParam>(Vector2d(source.size(0.1), source.size(0.1)));
    c = rounded<TypeParam>(c);
    const Vector2d slope = per.asDiagonal() * Vector2d(c(3), c(4));
    const double root = std::sqrt(2.0);
    const Matrix2d hessian =
        per.asDiagonal() * Matrix2d{{2 * c(0), root * c(1)}, {root * c(1), 2 * c(2)}} * per.asDiagonal();
    const Matrix2d first = Matrix2d::Identity() + slope * slope.transpose();
    const Matrix2d second = hessian / std::sqrt(1 + slope.squaredNorm());
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix2d> shape(second, first, Eigen::EigenvaluesOnly);
    const auto k = principal_curvatures(
        graph_of(equation<TypeParam>(c.row(0)), static_cast<real>(per[0]), static_cast<real>(per[1])));
    ASSERT_NEAR(k.k1, -shape.eigenvalues()[0], 20 * TypeParam::kRounding * hessian.norm());
    ASSERT_NEAR(k.k2, -shape.eigenvalues()[1], 20 * TypeParam::kRounding * hessian.norm());
  }
}

/// Vertices anywhere in the unit box, its corners first so that the device has the same units, with any neighbours.
template <typename As>
CurvatureStep::Rest anything(int count) {
  Source source;
  std::mt19937 random(5);
  CurvatureStep::Rest rest;
  rest.positions = rounded<As>(source.gaussian(count, 3).cwiseAbs().cwiseMin(1));
  rest.positions.row(0).setZero();
  rest.positions.row(1).setOnes();
  rest.normals = source.gaussian(count, 3);
  rest.normals.rowwise().normalize();
  rest.normals.row(2).setZero();
  rest.normals = rounded<As>(rest.normals);
  rest.offsets = {0};
  for (int v = 0; v < count; ++v) {
    const int few = v % 5 == 0 ? 4 : 40;  // Places, so that some neighbourhoods are told from a few.
    for (int k = 0; k < v % 30; ++k) {
      rest.neighbours.push_back((v + 1 + static_cast<int>(random() % static_cast<unsigned>(few))) % count);
    }
    rest.offsets.push_back(static_cast<int>(rest.neighbours.size()));
  }
  return rest;
}

template <typename As>
Eigen::RowVector2d curvatures_at(const CurvatureStep::Rest& rest, int v) {
  using Vec3 = typename As::Vec3;
  using real = typename As::real;
  auto vector = [](const Eigen::RowVector3d& a) {
    return Vec3{static_cast<real>(a[0]), static_cast<real>(a[1]), static_cast<real>(a[2])};
  };
  const auto at = static_cast<size_t>(v);
  const auto first = rest.neighbours.begin() + rest.offsets[at], last = rest.neighbours.begin() + rest.offsets[at + 1];
  auto offset = [&](int neighbour) {
    return sub3(vector(rest.positions.row(neighbour)), vector(rest.positions.row(v)));
  };
  const Vec3 normal = vector(rest.normals.row(v));
  const auto plane = plane_normal_to(normal);
  typename As::Spread spread = As::no_spread();
  if (last - first >= 5) {
    for (auto k = first; k < last; ++k) spread = spread_to(spread, plane, normal, offset(*k));
  }
  const auto units = units_of(spread, plane);
  typename As::Triangle triangle = As::no_equations();
  for (auto k = first; k < last; ++k) triangle = fold(triangle, terms_at(units, normal, offset(*k)));
  const auto rows = orthogonal(rows_of(triangle), sizeof(real));
  const auto k = principal_curvatures(graph_of(coefficients(rows), units.per_u, units.per_w));
  return {k.k1, k.k2};
}

TYPED_TEST(QuadricFit, OnTheDeviceHasTheSameBits) {
  const std::shared_ptr<Backend> device = test::opencl_or_skip(TypeParam::kPrecision);
  if (!device) return;
  const int count = 20'000;
  const CurvatureStep::Rest rest = anything<TypeParam>(count);
  Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> found;
  device->curvature(rest)->fit(found);
  int different = 0, curved = 0;
  for (int v = 0; v < count; ++v) {
    const Eigen::RowVector2d expected = curvatures_at<TypeParam>(rest, v);
    different += found.row(v) == expected ? 0 : 1;
    curved += expected.isZero(0) ? 0 : 1;
  }
  EXPECT_EQ(different, 0) << "of " << count << " on " << device->device();
  EXPECT_GT(curved, count / 2);
}

}  // namespace
}  // namespace swage
