#include "orient.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "expansion.h"

namespace swage {
namespace {

constexpr double kUnitRoundoff = std::numeric_limits<double>::epsilon() / 2;
// Of a determinant of rounded differences, relative to the sum of its products' magnitudes (Shewchuk, section 4).
constexpr double kError2 = (3 + 16 * kUnitRoundoff) * kUnitRoundoff;
constexpr double kError3 = (7 + 56 * kUnitRoundoff) * kUnitRoundoff;

int sign(double x) { return (x > 0) - (x < 0); }

int exact_orient2d(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const auto bx = difference(b[0], a[0]), by = difference(b[1], a[1]);
  const auto cx = difference(c[0], a[0]), cy = difference(c[1], a[1]);
  return (bx * cy - by * cx).sign();
}

int exact_orient3d(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                   const Eigen::Vector3d& d) {
  const auto bx = difference(b[0], a[0]), by = difference(b[1], a[1]), bz = difference(b[2], a[2]);
  const auto cx = difference(c[0], a[0]), cy = difference(c[1], a[1]), cz = difference(c[2], a[2]);
  const auto dx = difference(d[0], a[0]), dy = difference(d[1], a[1]), dz = difference(d[2], a[2]);
  return ((by * cz - bz * cy) * dx + (bz * cx - bx * cz) * dy + (bx * cy - by * cx) * dz).sign();
}

}  // namespace

int orient2d(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const Eigen::Vector2d ab = b - a, ac = c - a;
  const double first = ab[0] * ac[1], second = ab[1] * ac[0];
  const double area = first - second, bound = kError2 * (std::abs(first) + std::abs(second));
  if (std::abs(area) > bound || bound == 0) return sign(area);
  return exact_orient2d(a, b, c);
}

int orient3d(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& d) {
  const Eigen::Vector3d ab = b - a, ac = c - a, ad = d - a;
  const Eigen::Array3d first(ab[1] * ac[2], ab[2] * ac[0], ab[0] * ac[1]);
  const Eigen::Array3d second(ab[2] * ac[1], ab[0] * ac[2], ab[1] * ac[0]);
  const double volume = (first - second).matrix().dot(ad);
  const double bound = kError3 * (first.abs() + second.abs()).matrix().dot(ad.cwiseAbs());
  if (std::abs(volume) > bound || bound == 0) return sign(volume);
  return exact_orient3d(a, b, c, d);
}

}  // namespace swage
