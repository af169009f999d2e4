#include <cmath>
#include <numbers>

#include "resize_models.h"

namespace swage::test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

constexpr int kHoops = 9;

/// Between two hoops the paper sinks in.
Outline paper(const Assembler& made) {
  Outline profile = {{0, 11}};
  const int steps = kHoops * made.steps(2);
  for (int k = 0; k <= steps; ++k) {
    const double part = static_cast<double>(k) / steps, angle = (part - 0.5) * 0.72 * pi;
    const double hoop = std::abs(std::cos(kHoops * pi * part));
    profile.emplace_back(29.4 * std::cos(angle) + 0.8 * hoop, 30 + 19 * std::sin(angle) / std::sin(0.36 * pi));
  }
  profile.front()[1] = profile[1][1];
  profile.emplace_back(0, profile.back()[1]);
  return profile;
}

}  // namespace

Assembled lantern(double detail) {
  Assembler made(detail);
  const int around = made.steps(32);
  const auto rim = [&](double radius, double low, double high) {
    return turned({{0, low}, {radius, low}, {radius, high}, {0, high}}, around);
  };
  made.add("paper", turned(paper(made), around));
  made.add("lower rim", rim(15.5, 6.5, 12));
  made.add("upper rim", rim(15.5, 48, 53.5));
  made.add("foot", moved(turned({{0, 3.8}, {11, 3.8}, {12.5, 6.5}, {0, 6.5}}, around), {0, 0, 0}));
  made.add("bead", moved(ball({2.6, 2.0, 2.6}, made.steps(12)), {0, 2.0, 0}));
  Path handle;
  for (const Vector2d& p : arc({0, 53}, {13.5, 7.2}, 0, pi, made.steps(14))) handle.emplace_back(p[0], p[1], 0);
  made.add("handle", rod(handle, 0.8, made.steps(8)));
  made.add("cord", moved(about(0, ring(1.2, 0.4, made.steps(12), made.steps(5))), {0, 60.2, 0}));
  return made.assembled();
}

}  // namespace swage::test
