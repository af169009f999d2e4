// The closest rotation's shared maths as C++, in single and double precision, against singular values by Eigen; and
// the device against the same C++, bit for bit.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>

#include "opencl_device.h"
#include "swage/steps.h"

namespace swage {
namespace {

// Each needs those before it.
// clang-format off
namespace in_single {
using real = float;
#include "lane.h"
using std::fabs, std::sqrt;
#include "shared/vec3.h"
#include "shared/mat3.h"
#include "shared/symmetric.h"
#include "shared/procrustes.h"
}  // namespace in_single
namespace in_double {
using real = double;
#include "lane.h"
using std::fabs, std::sqrt;
#include "shared/vec3.h"
#include "shared/mat3.h"
#include "shared/symmetric.h"
#include "shared/procrustes.h"
}  // namespace in_double
// clang-format on

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct Tolerances {
  double orthonormal;  // Of RᵀR.
  double loss;         // Of the trace, in parts of |M|.
};

struct Single {
  using real = float;
  static constexpr Tolerances kTolerances{1e-5, 2e-6};
  static constexpr Precision kPrecision = Precision::single;
  static auto closest(float xx, float xy, float xz, float yx, float yy, float yz, float zx, float zy, float zz) {
    using namespace in_single;
    return closest_rotation(mat3(vec3(xx, xy, xz), vec3(yx, yy, yz), vec3(zx, zy, zz)));
  }
};

struct Twice {
  using real = double;
  static constexpr Tolerances kTolerances{1e-14, 1e-10};
  static constexpr Precision kPrecision = Precision::twice;
  static auto closest(double xx, double xy, double xz, double yx, double yy, double yz, double zx, double zy,
                      double zz) {
    using namespace in_double;
    return closest_rotation(mat3(vec3(xx, xy, xz), vec3(yx, yy, yz), vec3(zx, zy, zz)));
  }
};

template <typename Arithmetic>
Matrix3d closest(const Matrix3d& m) {
  const Eigen::Matrix<typename Arithmetic::real, 3, 3> n = m.cast<typename Arithmetic::real>();
  const auto r = Arithmetic::closest(n(0, 0), n(0, 1), n(0, 2), n(1, 0), n(1, 1), n(1, 2), n(2, 0), n(2, 1), n(2, 2));
  return Matrix3d{{r.x.x, r.x.y, r.x.z}, {r.y.x, r.y.y, r.y.z}, {r.z.x, r.z.y, r.z.z}};
}

/// Random matrices of a kind.
class Source {
 public:
  Matrix3d gaussian() {
    return Matrix3d::NullaryExpr([&] { return normal_(random_); });
  }
  Matrix3d rotation() {
    return Eigen::Quaterniond(normal_(random_), normal_(random_), normal_(random_), normal_(random_))
        .normalized()
        .toRotationMatrix();
  }
  Matrix3d with(double a, double b, double c) { return rotation() * Vector3d(a, b, c).asDiagonal() * rotation(); }
  /// Between low and 1, as often in each decade.
  double size(double low) { return std::pow(low, std::uniform_real_distribution<double>(0, 1)(random_)); }
  int small_integer() { return std::uniform_int_distribution<int>(-1, 1)(random_); }

 private:
  std::mt19937_64 random_{7};
  std::normal_distribution<double> normal_;
};

struct Kind {
  std::string name;
  std::function<Matrix3d(Source&)> draw;
};

std::vector<Kind> kinds() {
  return {
      {"gaussian", [](Source& s) { return s.gaussian(); }},
      {"near a rotation", [](Source& s) { return Matrix3d(s.rotation() + 0.01 * s.gaussian()); }},
      {"nearly flat", [](Source& s) { return s.with(1, 0.5, 1e-6); }},
      {"reflection near a double root", [](Source& s) { return s.with(1, 0.5, -0.4999); }},
      {"reflection near a double root, any gap", [](Source& s) { return s.with(1, 0.5, -0.5 + 0.5 * s.size(1e-12)); }},
      {"reflection near a triple root",
       [](Source& s) { return s.with(1, 1 - 0.1 * s.size(1e-12), -1 + 0.1 * s.size(1e-12)); }},
      {"minus a rotation", [](Source& s) { return Matrix3d(-s.rotation()); }},
      {"near rank one", [](Source& s) { return s.with(1, 1e-5, 1e-5); }},
      {"reflection near rank one", [](Source& s) { return s.with(1, 1e-5, -1e-5); }},
      {"rank one", [](Source& s) { return Matrix3d(s.gaussian().col(0) * s.gaussian().row(0)); }},
      {"rank none", [](Source&) { return Matrix3d(Matrix3d::Zero()); }},
      {"small integers", [](Source& s) { return Matrix3d::NullaryExpr([&] { return s.small_integer(); }); }},
      {"diagonal", [](Source& s) { return Matrix3d(Vector3d(s.gaussian().diagonal()).asDiagonal()); }},
      {"huge", [](Source& s) { return Matrix3d(1e20 * s.gaussian()); }},
      {"tiny", [](Source& s) { return Matrix3d(1e-20 * s.gaussian()); }},
  };
}

/// By how much tr Rᵀ M misses the best, in parts of |M|.
double loss(const Matrix3d& rotation, const Matrix3d& m) {
  const double size = m.norm();
  if (size == 0) return 0;
  const Matrix3d unit = m / size;
  const Eigen::JacobiSVD<Matrix3d> svd(unit, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double side = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  const Vector3d& values = svd.singularValues();
  return values[0] + values[1] + side * values[2] - rotation.cwiseProduct(unit).sum();
}

template <typename Arithmetic>
class ClosestRotation : public testing::Test {};

using Arithmetics = testing::Types<Single, Twice>;
TYPED_TEST_SUITE(ClosestRotation, Arithmetics);

TYPED_TEST(ClosestRotation, IsAProperRotationAndTheBest) {
  for (const Kind& kind : kinds()) {
    Source source;
    double worst_loss = 0, worst_product = 0, least_determinant = 1;
    for (int i = 0; i < 200'000; ++i) {
      const Matrix3d m = kind.draw(source).template cast<typename TypeParam::real>().template cast<double>();
      const Matrix3d R = closest<TypeParam>(m);
      ASSERT_TRUE(R.allFinite()) << kind.name << '\n' << m;
      worst_product = std::max(worst_product, (R.transpose() * R - Matrix3d::Identity()).cwiseAbs().maxCoeff());
      least_determinant = std::min(least_determinant, R.determinant());
      worst_loss = std::max(worst_loss, loss(R, m));
    }
    EXPECT_LT(worst_loss, TypeParam::kTolerances.loss) << kind.name;
    EXPECT_LT(worst_product, TypeParam::kTolerances.orthonormal) << kind.name;
    EXPECT_GT(least_determinant, 0.99) << kind.name;
  }
}

TYPED_TEST(ClosestRotation, OfNothingIsTheIdentity) {
  EXPECT_EQ(closest<TypeParam>(Matrix3d::Zero()), Matrix3d::Identity());
}

TEST(ClosestScale, IsThatOfTheEdges) {
  const in_double::Mat3 identity{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const in_double::Mat3 edges{{6, 1, 0}, {0, 6, 0}, {0, 0, 6}};
  EXPECT_DOUBLE_EQ(in_double::closest_scale(identity, edges, 1 / 9.), 2);
  EXPECT_EQ(in_double::closest_scale(identity, edges, -1 / 9.), 0);
  EXPECT_EQ(in_double::closest_scale(identity, edges, 0), 1);
}

/// Elements of three unit edges along the axes, all at one place: their covariances are what the edges are turned into.
PairsRest axes(int count) {
  PairsRest rest;
  rest.vertices.resize(4 * count, 3);
  rest.pairs.resize(3 * count, 2);
  rest.weights.setOnes(3 * count);
  rest.offsets = {0};
  for (int i = 0; i < count; ++i) {
    rest.vertices.middleRows(4 * i, 4) << Eigen::RowVector3d::Zero(), Matrix3d::Identity();
    for (int k = 0; k < 3; ++k) rest.pairs.row(3 * i + k) << 4 * i, 4 * i + 1 + k;
    rest.offsets.push_back(3 * i + 3);
  }
  return rest;
}

TYPED_TEST(ClosestRotation, OnTheDeviceHasTheSameBits) {
  const std::shared_ptr<Backend> device = test::opencl_or_skip(TypeParam::kPrecision);
  if (!device) return;
  const int each = 2'000, count = each * static_cast<int>(kinds().size());
  const PairsRest rest = axes(count);
  Positions positions = Positions::Zero(4 * count, 3);
  Source source;
  for (int i = 0; i < count; ++i) {
    const Matrix3d m = kinds()[static_cast<size_t>(i / each)].draw(source);
    positions.middleRows(4 * i + 1, 3) =
        m.transpose().template cast<typename TypeParam::real>().template cast<double>();
  }
  Transforms rotations;
  device->rotation(rest)->fit(positions, {}, rotations);
  int different = 0;
  for (int i = 0; i < count; ++i) {
    const Matrix3d expected = closest<TypeParam>(positions.middleRows(4 * i + 1, 3).transpose());
    const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rows = expected;
    different += (rotations.row(i).array() == Eigen::Map<const Eigen::Array<double, 1, 9>>(rows.data())).all() ? 0 : 1;
  }
  EXPECT_EQ(different, 0) << "of " << count << " on " << device->device();
}

}  // namespace
}  // namespace swage
