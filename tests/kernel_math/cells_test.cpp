// The carry step's shared maths as C++, in single and double precision, against Eigen.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace swage {
namespace {

// Each needs those before it.
// clang-format off
namespace in_single {
using real = float;
using std::ceil, std::fabs, std::floor, std::sqrt;
#include "shared/vec3.h"
#include "shared/slippage.h"
#include "shared/cells.h"
}  // namespace in_single
namespace in_double {
using real = double;
using std::ceil, std::fabs, std::floor, std::sqrt;
#include "shared/vec3.h"
#include "shared/slippage.h"
#include "shared/cells.h"
}  // namespace in_double
// clang-format on

using Eigen::Matrix3d, Eigen::RowVector3d, Eigen::Vector3d;

struct Single {
  using real = float;
  using Vec3 = in_single::Vec3;
  using Places = in_single::Places;
  using Range = in_single::Range;
  static in_single::Slippage no_slippage() { return in_single::no_slippage(); }
  static constexpr double kRounding = 1e-6;
};
struct Twice {
  using real = double;
  using Vec3 = in_double::Vec3;
  using Places = in_double::Places;
  using Range = in_double::Range;
  static in_double::Slippage no_slippage() { return in_double::no_slippage(); }
  static constexpr double kRounding = 1e-14;
};

template <typename As>
class CellMaths : public testing::Test {
 protected:
  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  /// As the type sees it.
  static double rounded(double x) { return static_cast<double>(static_cast<typename As::real>(x)); }
  Matrix3d triangle(double low, double high) {
    return Matrix3d::NullaryExpr([&] { return rounded(number(low, high)); });
  }
  typename As::Vec3 vec(const Vector3d& v) const {
    const Eigen::Vector3<typename As::real> seen = v.cast<typename As::real>();
    return {seen[0], seen[1], seen[2]};
  }
  typename As::Places places(const Matrix3d& corners) const {
    return {vec(corners.col(0)), vec(corners.col(1)), vec(corners.col(2))};
  }
  static Vector3d back(const typename As::Vec3& v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
  }

  std::mt19937_64 random_{11};
};

using Types = testing::Types<Single, Twice>;
TYPED_TEST_SUITE(CellMaths, Types);

/// By how much the axis that separates them best does so, of all thirteen, each in units of its projection of the cube;
/// below 0 where none does.
double separation(const Matrix3d& corners, const RowVector3d& middle, double radius) {
  Matrix3d sides;
  for (int k = 0; k < 3; ++k) sides.row(k) = corners.row((k + 1) % 3) - corners.row(k);
  std::vector<RowVector3d> axes = {sides.row(0).cross(sides.row(1))};
  for (int u = 0; u < 3; ++u) {
    axes.emplace_back(RowVector3d::Unit(u));
    for (int k = 0; k < 3; ++k) axes.emplace_back(RowVector3d::Unit(u).cross(sides.row(k)));
  }
  double most = -1e300;
  for (const RowVector3d& axis : axes) {
    const double size = axis.cwiseAbs().sum();
    if (size == 0) continue;
    const Vector3d at = (corners.rowwise() - middle) * axis.transpose();
    most = std::max(most, std::max(at.minCoeff(), -at.maxCoeff()) / size - radius);
  }
  return most;
}

TYPED_TEST(CellMaths, RowsOfCubesThatMeetATriangleAreThoseThatNoAxisSeparates) {
  const double radius = 0.5;
  int inside = 0, outside = 0, rows = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Matrix3d corners = this->triangle(0, trial % 3 == 0 ? 9 : 3);
    const auto p = this->places(corners);
    for (int k = 0; k < 9; ++k) {
      if (k + 1 < corners.col(2).minCoeff() || k > corners.col(2).maxCoeff()) continue;
      const auto z = static_cast<typename TypeParam::real>(k + 0.5);
      const auto y_range = rows_at(p, z, static_cast<typename TypeParam::real>(radius));
      for (int j = 0; j < 9; ++j) {
        const auto y = static_cast<typename TypeParam::real>(j + 0.5);
        const auto x_range = cubes_at(p, y, z, static_cast<typename TypeParam::real>(radius));
        for (int i = 0; i < 9; ++i) {
          const double x = i + 0.5;
          const double apart = separation(corners, {x, j + 0.5, k + 0.5}, radius);
          const bool in_row = x >= static_cast<double>(x_range.low) && x <= static_cast<double>(x_range.high);
          const bool found = in_row && y >= y_range.low && y <= y_range.high;
          if (apart > 100 * TypeParam::kRounding) {
            EXPECT_FALSE(found) << trial << ": " << i << ' ' << j << ' ' << k << " by " << apart;
            ++outside;
          } else if (apart < -100 * TypeParam::kRounding) {
            EXPECT_TRUE(found) << trial << ": " << i << ' ' << j << ' ' << k << " by " << apart;
            ++inside;
          }
        }
        rows += y >= y_range.low && y <= y_range.high ? 1 : 0;
      }
    }
  }
  EXPECT_GT(inside, 3000);
  EXPECT_GT(outside, 50'000);
  EXPECT_LT(rows, inside) << "rows are left out as a whole";
}

TYPED_TEST(CellMaths, CellsOfARangeAreThoseWhoseMiddlesItHas) {
  using real = typename TypeParam::real;
  for (const auto& [low, high, first, last] : {std::array<double, 4>{0.4, 2.6, 0, 2},
                                               {0.5, 2.5, 0, 2},
                                               {0.51, 2.49, 1, 1},
                                               {-1e20, 1e20, 0, 4},
                                               {7, 9, 5, 4},
                                               {-9, -7, 0, -1},
                                               {3, 1, 3, 0},
                                               {1e30, -1e30, 5, -1}}) {
    const auto cells = cells_in(typename TypeParam::Range{static_cast<real>(low), static_cast<real>(high)}, 5);
    EXPECT_EQ(cells.first, first) << low << " to " << high;
    EXPECT_EQ(cells.last, last) << low << " to " << high;
  }
}

TYPED_TEST(CellMaths, NormalsAreUnitOrNone) {
  using real = typename TypeParam::real;
  for (int trial = 0; trial < 300; ++trial) {
    const double size = std::pow(10, this->number(-12, 12));
    const Matrix3d corners = this->triangle(-1, 1);
    const Vector3d first = size * (corners.row(1) - corners.row(0)), second = size * (corners.row(2) - corners.row(1));
    const Vector3d normal = first.cross(second).normalized();
    const auto found = certain_normal(this->vec(first), this->vec(second), static_cast<real>(1e-5));
    EXPECT_LT((this->back(found) - normal).norm(), 100 * TypeParam::kRounding) << size;
  }
  const auto low = [&](double height) {
    return this->back(certain_normal(this->vec({1, 0, 0}), this->vec({-0.5, height, 0}), static_cast<real>(1e-5)));
  };
  EXPECT_EQ(low(1.01e-5), Vector3d(0, 0, 1));
  EXPECT_EQ(low(0.99e-5), Vector3d(0, 0, 0));
  EXPECT_EQ(this->back(certain_normal(this->vec({0, 0, 0}), this->vec({0, 0, 0}), static_cast<real>(1e-5))),
            Vector3d(0, 0, 0));
}

TYPED_TEST(CellMaths, SlippagesAreWeightedMeans) {
  using real = typename TypeParam::real;
  const auto one = add_normal(TypeParam::no_slippage(), real{3}, this->vec({1, 0, 0}));
  const auto both = add_normal(one, real{1}, this->vec({0, -0.6, 0.8}));
  EXPECT_LT((this->back(mean_slippage(both)) - Vector3d(0.75, 0.15, 0.2)).norm(), TypeParam::kRounding);
  EXPECT_EQ(this->back(mean_slippage(TypeParam::no_slippage())), Vector3d(0, 0, 0));
}

TYPED_TEST(CellMaths, BlendsAreStraight) {
  using real = typename TypeParam::real;
  const Vector3d low(1, 2, 3), high(5, 2, 7);
  for (const double at : {0.0, 0.25, 1.0, 1.5, -0.5}) {
    const auto found = blend3(static_cast<real>(at), this->vec(low), this->vec(high));
    EXPECT_LT((this->back(found) - (low + at * (high - low))).norm(), 10 * TypeParam::kRounding);
  }
}

}  // namespace
}  // namespace swage
