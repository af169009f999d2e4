// The principal directions' shared maths as C++, in single and double precision, against eigenvalues by Eigen.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <random>

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
#include "shared/principal.h"
}  // namespace in_single
namespace in_double {
using real = double;
#include "lane.h"
using std::fabs, std::sqrt;
#include "shared/vec3.h"
#include "shared/mat3.h"
#include "shared/symmetric.h"
#include "shared/principal.h"
}  // namespace in_double
// clang-format on

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct Found {
  Vector3d spreads;
  Matrix3d directions;  // Rows.
};

template <typename Principal>
Found found(const Principal& p) {
  const auto row = [](const auto& v) { return Eigen::RowVector3d(v.x, v.y, v.z); };
  Found result{{p.rest.xx, p.rest.yy, p.rest.zz}, {}};
  result.directions << row(p.directions.x), row(p.directions.y), row(p.directions.z);
  return result;
}

struct Single {
  static constexpr double kTolerance = 2e-6;
  static Found of(const Matrix3d& m) {
    using namespace in_single;
    const Eigen::Matrix3f f = m.cast<float>();
    return found(principal(symmetric(f(0, 0), f(0, 1), f(0, 2), f(1, 1), f(1, 2), f(2, 2))));
  }
};

struct Twice {
  static constexpr double kTolerance = 1e-14;
  static Found of(const Matrix3d& m) {
    using namespace in_double;
    return found(principal(symmetric(m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2))));
  }
};

template <typename Arithmetic>
void expect_principal(const Matrix3d& m, const std::string& what) {
  const Found p = Arithmetic::of(m);
  const Vector3d expected = Eigen::SelfAdjointEigenSolver<Matrix3d>(m, Eigen::EigenvaluesOnly).eigenvalues();
  ASSERT_LT((p.spreads - expected).norm(), 3 * Arithmetic::kTolerance) << what;
  ASSERT_LT((p.directions * p.directions.transpose() - Matrix3d::Identity()).norm(), 5 * Arithmetic::kTolerance)
      << what;
  ASSERT_LT((p.directions.transpose() * p.spreads.asDiagonal() * p.directions - m).norm(), 5 * Arithmetic::kTolerance)
      << what;
}

template <typename Arithmetic>
class PrincipalMath : public testing::Test {};
using Arithmetics = testing::Types<Single, Twice>;
TYPED_TEST_SUITE(PrincipalMath, Arithmetics);

TYPED_TEST(PrincipalMath, IsEigensOfEverySpread) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (const Vector3d& spreads :
       {Vector3d(0.2, 0.3, 0.5), Vector3d(0, 0, 1), Vector3d(0, 0.5, 0.5), Vector3d(1. / 3, 1. / 3, 1. / 3),
        Vector3d(1e-12, 1e-6, 1), Vector3d(0, 0, 0), Vector3d(0.25, 0.25, 0.5), Vector3d(1e-5, 1.001e-5, 1)}) {
    for (int i = 0; i < 200; ++i) {
      const Matrix3d turn = Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
                                .normalized()
                                .toRotationMatrix();
      expect_principal<TypeParam>(turn * spreads.asDiagonal() * turn.transpose(), "spreads of a kind");
    }
  }
}

TYPED_TEST(PrincipalMath, BearsWhatIsThereAlready) {
  for (const Vector3d& spreads : {Vector3d(3, 2, 1), Vector3d(1, 3, 2), Vector3d(2, 1, 3), Vector3d(1, 2, 3)}) {
    expect_principal<TypeParam>((spreads / 6).asDiagonal(), "diagonal");
  }
  Matrix3d m;
  m << 0.3, 0.2, 0, 0.2, 0.3, 0, 0, 0, 0.4;
  expect_principal<TypeParam>(m, "one pair");
}

}  // namespace
}  // namespace swage
