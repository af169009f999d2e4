#include "orient.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "expansion.h"

namespace swage {
namespace {

// 128 bits hold a determinant of integer coordinates below 2^40.
__extension__ using Wide = __int128;
using IntegerPoint = std::array<long, 3>;

int sign(Wide x) { return (x > 0) - (x < 0); }

int exact_side(const IntegerPoint& a, const IntegerPoint& b, const IntegerPoint& c, const IntegerPoint& d) {
  const auto across = [&](const IntegerPoint& p, size_t k) { return Wide(p[k % 3]) - Wide(a[k % 3]); };
  Wide sum = 0;
  for (size_t k = 0; k < 3; ++k) {
    sum += across(d, k) * (across(b, k + 1) * across(c, k + 2) - across(b, k + 2) * across(c, k + 1));
  }
  return sign(sum);
}

Eigen::Vector3d point(const IntegerPoint& p, double unit = 1) {
  return unit * Eigen::Vector3d(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]));
}

Eigen::Vector2d flat(const IntegerPoint& p) { return point(p).head<2>(); }

class Random {
 public:
  long number(long range) { return std::uniform_int_distribution<long>(-range, range)(engine_); }
  IntegerPoint point(long range) { return {number(range), number(range), number(range)}; }

 private:
  std::mt19937 engine_{7};
};

/// A point of the plane through the three, or one beside it.
IntegerPoint near_plane(const IntegerPoint& a, const IntegerPoint& b, const IntegerPoint& c, Random& random) {
  const long i = random.number(9), j = random.number(9);
  IntegerPoint d{};
  for (size_t k = 0; k < 3; ++k) d[k] = a[k] + i * (b[k] - a[k]) + j * (c[k] - a[k]);
  d[static_cast<size_t>(std::abs(random.number(2)))] += random.number(1);
  return d;
}

TEST(Orient, SaysOnWhichSideAPointLies) {
  const Eigen::Vector3d a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  EXPECT_EQ(orient3d(a, b, c, {0.3, 0.3, 1e-300}), 1);
  EXPECT_EQ(orient3d(a, b, c, {0.3, 0.3, -1e-300}), -1);
  EXPECT_EQ(orient3d(a, b, c, {7, -9, 0}), 0);
  EXPECT_EQ(orient2d({0, 0}, {1, 0}, {5, 1e-300}), 1);
  EXPECT_EQ(orient2d({0, 0}, {1, 0}, {5, -1e-300}), -1);
  EXPECT_EQ(orient2d({0.1, 0.1}, {0.2, 0.2}, {0.3, 0.3}), 0);
}

TEST(Orient, AgreesWithIntegersNearPlanes) {
  Random random;
  int coplanar = 0, far = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    // Wide apart: the products need far more than the 53 bits of a double.
    const long range = trial % 2 == 0 ? 1L << 34 : 1L << 12;
    const IntegerPoint a = random.point(range), b = random.point(range), c = random.point(range);
    const IntegerPoint d = near_plane(a, b, c, random);
    const int side = exact_side(a, b, c, d);
    for (const double unit : {1.0, 0x1p-200, 0x1p+100}) {
      ASSERT_EQ(orient3d(point(a, unit), point(b, unit), point(c, unit), point(d, unit)), side);
      ASSERT_EQ(orient3d(point(b, unit), point(a, unit), point(c, unit), point(d, unit)), -side);
      ASSERT_EQ(orient3d(point(d, unit), point(c, unit), point(b, unit), point(a, unit)), side);
    }
    (side == 0 ? coplanar : far) += 1;
  }
  EXPECT_GT(coplanar, 2000);
  EXPECT_GT(far, 2000);
}

TEST(Orient, AgreesWithIntegersNearLines) {
  Random random;
  for (int trial = 0; trial < 20000; ++trial) {
    const IntegerPoint a = random.point(1L << 40), b = random.point(1L << 40);
    IntegerPoint c{};
    for (size_t k = 0; k < 3; ++k) c[k] = a[k] + 3 * (b[k] - a[k]);
    c[0] += random.number(1);
    const Wide area = Wide(b[0] - a[0]) * (c[1] - a[1]) - Wide(b[1] - a[1]) * (c[0] - a[0]);
    ASSERT_EQ(orient2d(flat(a), flat(b), flat(c)), sign(area));
  }
}

// 1 - 2^-100 is no double.
TEST(Orient, TellsApartWhatDifferencesRoundAway) {
  const double tiny = 0x1p-100;
  for (const int side : {1, -1}) {
    EXPECT_EQ(orient3d({side * tiny, 0, 0}, {1, 1, 0}, {0, 0, 1}, {2, 2, 0}), side);
    EXPECT_EQ(orient2d({side * tiny, 0}, {1, 1}, {2, 2}), -side);
  }
}

TEST(Orient, CollinearPointsAreCoplanarWithAll) {
  const Eigen::Vector3d a(0.1, 0.1, 0.1), b(0.7, 0.7, 0.7), c(0.3, 0.3, 0.3);
  EXPECT_EQ(orient3d(a, b, c, {5, -3, 0.123}), 0);
  EXPECT_EQ(orient3d(a, a, b, {5, -3, 0.123}), 0);
}

TEST(Expansion, IsSumAndProductWithoutRounding) {
  const auto third = difference(1, 0x1p-80);  // 1 - 2^-80
  const auto square = third * third;          // 1 - 2^-79 + 2^-160
  EXPECT_EQ((square - difference(1, 0x1p-79)).sign(), 1);
  const auto rest = square - difference(1, 0x1p-79) - difference(0x1p-160, 0);
  EXPECT_EQ(rest.sign(), 0);
  EXPECT_EQ(rest.size(), 0u);
}

}  // namespace
}  // namespace swage
