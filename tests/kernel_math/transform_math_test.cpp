// The transform and coupling steps' shared maths as C++, in single and double precision, against Eigen.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>
#include <random>

namespace swage {
namespace {

// Each needs those before it.
// clang-format off
namespace in_single {
using real = float;
using std::fabs, std::sqrt;
#include "lane.h"
#include "shared/vec3.h"
#include "shared/mat3.h"
#include "shared/symmetric.h"
#include "shared/wide.h"
#include "shared/transform.h"
#include "shared/triangle.h"
#include "row.h"
#include "shared/rows.h"
#include "shared/coupling.h"
}  // namespace in_single
namespace in_double {
using real = double;
using std::fabs, std::sqrt;
#include "lane.h"
#include "shared/vec3.h"
#include "shared/mat3.h"
#include "shared/symmetric.h"
#include "shared/wide.h"
#include "shared/transform.h"
#include "shared/triangle.h"
#include "row.h"
#include "shared/rows.h"
#include "shared/coupling.h"
}  // namespace in_double
// clang-format on

using Eigen::Matrix3d, Eigen::Vector3d;

struct Single {
  using real = float;
  using Vec3 = in_single::Vec3;
  using Mat3 = in_single::Mat3;
  using Symmetric = in_single::Symmetric;
  using WideVec3 = in_single::WideVec3;
  using WideSymmetric = in_single::WideSymmetric;
  using Corners = in_single::Corners;
  using Sides = in_single::Sides;
  using Rows = in_single::Rows;
  static constexpr double kTolerance = 2e-6;
  static in_single::TriangleTerms no_edges(Vec3 normal, float regularizer, float normal_regularizer) {
    return in_single::no_edges(normal, regularizer, normal_regularizer);
  }
};

struct Twice {
  using real = double;
  using Vec3 = in_double::Vec3;
  using Mat3 = in_double::Mat3;
  using Symmetric = in_double::Symmetric;
  using WideVec3 = in_double::WideVec3;
  using WideSymmetric = in_double::WideSymmetric;
  using Corners = in_double::Corners;
  using Sides = in_double::Sides;
  using Rows = in_double::Rows;
  static constexpr double kTolerance = 1e-14;
  static in_double::TriangleTerms no_edges(Vec3 normal, double regularizer, double normal_regularizer) {
    return in_double::no_edges(normal, regularizer, normal_regularizer);
  }
};

template <typename Maths>
class TransformMath : public testing::Test {
 public:
  using real = typename Maths::real;
  using Vec3 = typename Maths::Vec3;
  using Mat3 = typename Maths::Mat3;
  using Rows = typename Maths::Rows;
  using Symmetric = typename Maths::Symmetric;

  static real to(double number) { return static_cast<real>(number); }
  static Vec3 to(const Vector3d& v) { return {to(v[0]), to(v[1]), to(v[2])}; }
  static Mat3 to(const Matrix3d& m) { return {to(Vector3d(m.row(0))), to(Vector3d(m.row(1))), to(Vector3d(m.row(2)))}; }
  static Rows rows(const Matrix3d& m) {
    const Mat3 a = to(m);
    return {{a.x.x, a.x.y, a.x.z, 0}, {a.y.x, a.y.y, a.y.z, 0}, {a.z.x, a.z.y, a.z.z, 0}};
  }
  static Matrix3d from(const Rows& a) {
    return Matrix3d{{a.x.x, a.x.y, a.x.z}, {a.y.x, a.y.y, a.y.z}, {a.z.x, a.z.y, a.z.z}};
  }
  static Symmetric symmetric(const Matrix3d& m) {
    return {to(m(0, 0)), to(m(0, 1)), to(m(0, 2)), to(m(1, 1)), to(m(1, 2)), to(m(2, 2))};
  }
  static Vector3d from(const Vec3& v) { return {v.x, v.y, v.z}; }
  static Matrix3d from(const Mat3& m) {
    Matrix3d matrix;
    matrix << from(m.x).transpose(), from(m.y).transpose(), from(m.z).transpose();
    return matrix;
  }
  static Matrix3d from(const Symmetric& s) {
    return Matrix3d{{s.xx, s.xy, s.xz}, {s.xy, s.yy, s.yz}, {s.xz, s.yz, s.zz}};
  }
  static Vector3d from(const typename Maths::WideVec3& v) { return {v.x, v.y, v.z}; }
  static Matrix3d from(const typename Maths::WideSymmetric& s) {
    const Vector3d diagonal = from(s.diagonal), mixed = from(s.mixed);
    return Matrix3d{
        {diagonal[0], mixed[0], mixed[1]}, {mixed[0], diagonal[1], mixed[2]}, {mixed[1], mixed[2], diagonal[2]}};
  }

  // Random, and as the precision has them: what is compared starts from the same numbers.
  Vector3d vector() {
    return from(to(Vector3d(Vector3d::NullaryExpr([&] { return normal_(random_); }))));
  }
  Matrix3d matrix() {
    return stored(Matrix3d::NullaryExpr([&] { return normal_(random_); }));
  }
  Matrix3d near_identity() { return stored(Matrix3d::Identity() + 0.1 * matrix()); }
  Matrix3d with_singular_values(const Vector3d& values) {
    const Eigen::JacobiSVD<Matrix3d> svd(matrix(), Eigen::ComputeFullU | Eigen::ComputeFullV);
    return stored(svd.matrixU() * values.asDiagonal() * svd.matrixV().transpose());
  }
  static Matrix3d stored(const Matrix3d& matrix) { return from(to(matrix)); }

 private:
  std::mt19937 random_{7};
  std::normal_distribution<double> normal_;
};

using Precisions = testing::Types<Single, Twice>;
TYPED_TEST_SUITE(TransformMath, Precisions);

constexpr int kRounds = 50000;

TYPED_TEST(TransformMath, InverseIsTheInverse) {
  for (int round = 0; round < kRounds; ++round) {
    const Matrix3d a = this->matrix();
    const auto inverse = damped_inverse(this->to(a));
    const double condition = a.norm() * a.inverse().norm();
    EXPECT_EQ(inverse.damped, 0);
    // The adjugate over the determinant loses up to the square of the condition, rounding of the cofactors among it.
    EXPECT_LT((this->from(inverse.matrix) - a.inverse()).norm() / a.inverse().norm(),
              TypeParam::kTolerance * condition * condition)
        << a;
  }
}

TYPED_TEST(TransformMath, SingularMatricesAreDamped) {
  for (const Vector3d& values : {Vector3d(1, 0.5, 0), Vector3d(1, 0, 0), Vector3d(1, 1e-10, 1e-10)}) {
    for (int round = 0; round < 200; ++round) {
      const Matrix3d a = this->with_singular_values(values);
      const auto inverse = damped_inverse(this->to(a));
      EXPECT_EQ(inverse.damped, 1) << values.transpose();
      const double damping = 1e-6 * a.squaredNorm();
      const Eigen::JacobiSVD<Matrix3d> svd(a, Eigen::ComputeFullU | Eigen::ComputeFullV);
      const Vector3d factors = svd.singularValues().array() / (svd.singularValues().array().square() + damping);
      const Matrix3d expected = svd.matrixV() * factors.asDiagonal() * svd.matrixU().transpose();
      // What rounding leaves of vanishing singular values meets 1 / damping.
      EXPECT_LT((this->from(inverse.matrix) - expected).norm() / expected.norm(), 1e5 * TypeParam::kTolerance);
    }
  }
}

TYPED_TEST(TransformMath, WeakDirectionsAboveNoiseAreNotDamped) {
  for (const Vector3d& values : {Vector3d(1, 1, 1e-5), Vector3d(1, 3e-3, 3e-3), Vector3d(1, 0.1, 1e-4)}) {
    for (int round = 0; round < 200; ++round) {
      EXPECT_EQ(damped_inverse(this->to(this->with_singular_values(values))).damped, 0) << values.transpose();
    }
  }
}

TYPED_TEST(TransformMath, TheZeroMatrixHasTheZeroInverse) {
  EXPECT_EQ(this->from(damped_inverse(this->to(Matrix3d(Matrix3d::Zero()))).matrix), Matrix3d::Zero());
}

TYPED_TEST(TransformMath, InversesAreScaleFree) {
  for (const double scale : {std::pow(2, -60), std::pow(2, 60)}) {
    for (const Vector3d& values : {Vector3d(3, 1, 0.2), Vector3d(3, 1, 0)}) {
      const Matrix3d a = this->with_singular_values(values);
      const auto inverse = damped_inverse(this->to(a)), scaled = damped_inverse(this->to(Matrix3d(scale * a)));
      EXPECT_EQ(scaled.damped, inverse.damped);
      EXPECT_EQ(scale * this->from(scaled.matrix), this->from(inverse.matrix));
    }
  }
}

TYPED_TEST(TransformMath, EdgeQuadraticsAreTheEnergyOfTheEdge) {
  const double weight = 1.75, normal_weight = 2.5, scale = 0.125;
  for (int round = 0; round < kRounds; ++round) {
    const Vector3d rest = this->vector(), edge = this->vector(), other = this->vector();
    Matrix3d transforms[2], inverses[2];
    Vector3d normals[2];
    auto side = [&](int k) {
      transforms[k] = this->near_identity(), inverses[k] = this->near_identity(), normals[k] = this->vector();
      return edge_side(this->to(Vector3d(transforms[k] * rest)), this->to(inverses[k]), this->to(normals[k]),
                       this->to(rest));
    };
    const auto first = side(0), sum = add_sides(first, side(1));
    const double target = ((transforms[0] * rest).norm() + (transforms[1] * rest).norm()) / 2;
    auto energy = [&](const Vector3d& e) {
      double total = scale * (e - rest).squaredNorm();
      for (int k = 0; k < 2; ++k) {
        total += weight * (inverses[k] * e - rest).squaredNorm() / rest.squaredNorm();
        total += normal_weight * weight * rest.norm() * std::pow(normals[k].dot(e) / target, 2);
      }
      return total;
    };
    const auto found = target_length(sum.length / 2, 0, this->to(rest));
    const auto quadratic =
        edge_quadratic(sum, 1, this->to(rest), this->to(weight), found, this->to(normal_weight), this->to(scale));
    auto value = [&](const Vector3d& e) {
      return e.dot(this->from(quadratic.block) * e) - 2 * this->from(quadratic.side).dot(e);
    };
    EXPECT_NEAR(found, target, 10 * TypeParam::kTolerance * target);
    EXPECT_NEAR(value(edge) - value(other), energy(edge) - energy(other),
                20 * TypeParam::kTolerance * (energy(edge) + energy(other)));
    double turned = 0;
    for (int k = 0; k < 2; ++k) turned += std::pow(normals[k].dot(transforms[k] * rest), 2);
    const double size = (normals[0].squaredNorm() + normals[1].squaredNorm()) * rest.squaredNorm();
    EXPECT_NEAR(sum.turned, turned, 100 * TypeParam::kTolerance * size);
  }
}

TYPED_TEST(TransformMath, AHalfOfTheSameSideTwiceIsTheSide) {
  const auto rest = this->to(this->vector());
  const auto side =
      edge_side(this->to(this->vector()), this->to(this->near_identity()), this->to(this->vector()), rest);
  const auto twice = add_sides(side, side);
  const auto one = edge_quadratic(side, 1, rest, 2, side.length, 3, 4);
  const auto half = edge_quadratic(twice, this->to(0.5), rest, 2, twice.length / 2, 3, 4);
  EXPECT_EQ(this->from(half.block), this->from(one.block));
  EXPECT_EQ(this->from(half.side), this->from(one.side));
}

TYPED_TEST(TransformMath, KeptAndFlattenedLengths) {
  const auto rest = this->to(Vector3d(1, 2, 2));
  const auto same = this->to(Matrix3d(2 * Matrix3d::Identity())), none = this->to(Matrix3d(Matrix3d::Zero()));
  const auto normal = this->to(Vector3d(0, 0, 1));
  const auto side = edge_side(apply3(same, rest), same, normal, rest),
             flat = edge_side(apply3(none, rest), same, normal, rest);
  EXPECT_EQ(target_length(side.length, 0, rest), 6);
  EXPECT_EQ(target_length(side.length, 4, rest), 4);
  EXPECT_NEAR(target_length(flat.length, 0, rest), 3e-9, 1e-15);
}

TYPED_TEST(TransformMath, TriangleTermsAreTheFormulas) {
  for (int round = 0; round < kRounds; ++round) {
    const Matrix3d inverse = this->near_identity();
    const Vector3d normal = this->vector(), edge = this->vector(), rest = this->vector();
    const double own = round % 2;
    const auto none = TypeParam::no_edges(this->to(normal), this->to(0.25), this->to(0.75));
    const auto terms =
        add_edge(none, this->to(inverse), this->to(normal), this->to(edge), this->to(rest), 2, this->to(own), 4);
    const Matrix3d pulls = 0.25 * Matrix3d::Identity() + 0.75 * normal * normal.transpose();
    const Matrix3d side = pulls + edge * rest.transpose() / 4;
    EXPECT_LT((this->from(terms.right_hand_side) - side).norm(), TypeParam::kTolerance * side.norm());
    // Differences lose what cancels: tolerances are of what is subtracted.
    auto expect = [&](double term, double expected, double of) {
      EXPECT_NEAR(term, expected, 10 * TypeParam::kTolerance * of);
    };
    const double grown = std::pow((inverse * edge).norm() + rest.norm(), 2) / rest.squaredNorm();
    expect(terms.transform, 2 * (inverse * edge - rest).squaredNorm() / rest.squaredNorm(), 2 * grown);
    const double tilt = normal.squaredNorm() * rest.norm() / 2;
    expect(terms.normal, 2 * rest.norm() / 4 * std::pow(normal.dot(edge.normalized()), 2), tilt);
    expect(terms.scale, own * (edge - rest).squaredNorm(), std::pow(edge.norm() + rest.norm(), 2));
  }
}

TYPED_TEST(TransformMath, AMappedNormalIsTheImagesAndTangentsStay) {
  for (int round = 0; round < kRounds; ++round) {
    const Matrix3d transform = this->near_identity();
    const Vector3d normal = this->vector().normalized(), u = normal.unitOrthogonal(), v = normal.cross(u);
    const Matrix3d mapped = this->from(with_mapped_normal(this->to(transform), this->to(normal)));
    EXPECT_LT((mapped * u - transform * u).norm(), 10 * TypeParam::kTolerance);
    EXPECT_LT((mapped * v - transform * v).norm(), 10 * TypeParam::kTolerance);
    const Vector3d image = (transform * u).cross(transform * v);
    EXPECT_LT((mapped * normal - image / std::sqrt(image.norm())).norm(), 20 * TypeParam::kTolerance);
  }
}

TYPED_TEST(TransformMath, DistancesOfTransformsAreTheFormulas) {
  for (int round = 0; round < kRounds; ++round) {
    const Matrix3d transform = this->near_identity(), other = this->near_identity();
    const Vector3d direction = this->vector();
    EXPECT_NEAR(distance_from_identity(this->to(transform)), (transform - Matrix3d::Identity()).squaredNorm(),
                10 * TypeParam::kTolerance);
    EXPECT_NEAR(distance_from_normal(this->to(transform), this->to(direction)),
                (transform * direction - direction).squaredNorm(), 100 * TypeParam::kTolerance);
    const auto difference = sub_mat3(this->to(transform), this->to(other));
    EXPECT_NEAR(disagreement(difference, this->to(direction)), ((transform - other) * direction).squaredNorm(),
                20 * TypeParam::kTolerance * direction.squaredNorm());
  }
}

/// A random triangle's corners as the kernels get them, and their turns as Eigen has them.
template <typename Maths>
struct Triangle {
  Vector3d directions[3];
  Eigen::Quaterniond turns[3];
  typename Maths::Corners corners;
  typename Maths::Sides sides;

  Triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const Vector3d vectors[3] = {b - a, c - b, a - c};
    Vector3d cosines, sines;
    for (int k = 0; k < 3; ++k) directions[k] = vectors[k].normalized();
    for (int k = 0; k < 3; ++k) {
      const Vector3d last = -directions[(k + 2) % 3];
      turns[k] = Eigen::Quaterniond::FromTwoVectors(last, directions[k]);
      cosines[k] = last.dot(directions[k]);
      sines[k] = last.cross(directions[k]).norm();
    }
    using Test = TransformMath<Maths>;
    corners = {Test::to(Vector3d(directions[1].cross(directions[0]).normalized())), Test::to(cosines), Test::to(sines)};
    sides = {Test::to(directions[0]), Test::to(directions[1]), Test::to(directions[2])};
  }

  /// Eq. 27.
  double energy(const Matrix3d& transform) const {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      const Vector3d next = transform * directions[k], last = -(transform * directions[(k + 2) % 3]);
      sum += (next - turns[k] * last).squaredNorm();
    }
    return sum;
  }
};

TYPED_TEST(TransformMath, CornerMissesAreEq27) {
  for (int round = 0; round < kRounds; ++round) {
    const Triangle<TypeParam> triangle(this->vector(), this->vector(), this->vector());
    const Matrix3d transform = this->matrix();
    const auto misses = corner_misses(triangle.corners, map_sides(this->to(transform), triangle.sides));
    EXPECT_NEAR(sum_of_squares(misses), triangle.energy(transform),
                20 * TypeParam::kTolerance * transform.squaredNorm());
  }
}

TYPED_TEST(TransformMath, CornerPullIsTheGradient) {
  for (int round = 0; round < kRounds; ++round) {
    const Triangle<TypeParam> triangle(this->vector(), this->vector(), this->vector());
    const Matrix3d at = this->matrix(), toward = this->matrix();
    const Matrix3d pull = this->from(corner_pull(triangle.corners, this->to(at), triangle.sides));
    // Exact for a quadratic.
    const double slope = (triangle.energy(at + toward) - triangle.energy(at - toward)) / 4;
    EXPECT_NEAR(pull.cwiseProduct(toward).sum(), slope, 30 * TypeParam::kTolerance * at.norm() * toward.norm());
  }
}

TYPED_TEST(TransformMath, ProductsAreTheFormulas) {
  for (int round = 0; round < kRounds; ++round) {
    const Matrix3d a = this->matrix(), b = this->matrix();
    const Matrix3d vectors = a.transpose() * a, directions = b.transpose() * b;
    const Vector3d normal = this->vector();
    const Matrix3d own = this->from(own_product(this->rows(a), this->rows(vectors), this->rows(directions),
                                                this->rows(normal.transpose().replicate<3, 1>()).x, 3, this->to(0.5)));
    const Matrix3d expected = a * vectors + 0.5 * a + 3 * normal * normal.transpose() * a * directions;
    const double size = a.norm() * (vectors.norm() + 3 * normal.squaredNorm() * directions.norm() + 1);
    EXPECT_LT((own - expected).norm(), TypeParam::kTolerance * size);
    const Matrix3d shared = this->from(shared_product(this->rows(a), this->rows(b), this->rows(vectors)));
    EXPECT_LT((shared - (a - b) * vectors).norm(), TypeParam::kTolerance * (a.norm() + b.norm()) * vectors.norm());
  }
}

}  // namespace
}  // namespace swage
