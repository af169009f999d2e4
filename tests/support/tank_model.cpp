#include <cmath>
#include <numbers>

#include "resize_models.h"

namespace swage::test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

constexpr double kAxis = 8, kRadius = 6, kCap = 3.6, kEnd = 40;  // Height of the axis, radius, depth of a cap, length.

/// A turned part with its axis along x.
Mesh along_x(const Mesh& about_y, double x) { return moved(about(0, about_y), {x, kAxis, 0}); }

/// Shell and caps meet vertex by vertex.
void add_shell(Assembler& made) {
  const int around = made.steps(40);
  const double low = kCap, high = kEnd - kCap;
  made.add("shell", along_x(turned({{0, low}, {kRadius, low}, {kRadius, high}, {0, high}}, around), 0));
  Outline dome = {{0, 0}};
  for (const Vector2d& p : arc({0, 0}, {kRadius, kCap}, 0, pi / 2, made.steps(9))) dome.push_back(p);
  dome.back() = {0, kCap};
  const Mesh cap = along_x(turned(dome, around), 0);
  made.add("cap", moved(cap, {high, 0, 0}));
  Mesh other = cap;
  other.positions.col(0) *= -1;
  other.triangles.col(1).swap(other.triangles.col(2));
  made.add("cap", moved(other, {low, 0, 0}));
  for (const double x : {low, high}) made.add("seam", along_x(ring(kRadius, 0.22, around, made.steps(6)), x));
  for (const double x : {9.0, 31.0}) {
    made.add("strap", along_x(turned({{5.9, -0.6}, {6.5, -0.6}, {6.5, 0.6}, {5.9, 0.6}}, around), x));
  }
}

void add_feet(Assembler& made) {
  for (const double x : {9.0, 31.0}) {
    // A saddle under the shell, whose upper side is round.
    Outline outline = {{-5.4, 1.6}, {5.4, 1.6}};
    for (const Vector2d& p : arc({0, kAxis}, {6.3, 6.3}, -0.18 * pi, -0.82 * pi, made.steps(14))) outline.push_back(p);
    made.add("saddle", moved(quarter_turned(1, pulled(outline, 2)), {x, 0, 0}));
    for (const double z : {-4.4, 4.4}) {
      made.add("leg", moved(turned({{0, 0.4}, {0.7, 0.4}, {0.7, 1.7}, {0, 1.7}}, made.steps(16)), {x, 0, z}));
      made.add("foot", moved(slab({3, 0.5, 3}, 0.1), {x, 0.25, z}));
      made.add("foot bolt",
               moved(turned({{0, 0.4}, {0.35, 0.4}, {0.35, 0.8}, {0, 0.8}}, made.steps(12)), {x + 1.1, 0, z}));
    }
  }
}

/// A neck on the shell with flange and lid, bolted around.
void add_hatch(Assembler& made, double x, double radius, int bolts) {
  const int around = made.steps(32);
  const double base = kAxis + 5.4, top = kAxis + kRadius + 1.1;
  const auto add = [&](const std::string& name, const Outline& profile) {
    made.add(name, moved(turned(profile, around), {x, 0, 0}));
  };
  const auto disc = [&](double r, double low, double high) {
    return Outline{{0, low}, {r, low}, {r, high}, {0, high}};
  };
  add("hatch neck", disc(radius, base, top));
  add("hatch flange", disc(radius + 0.7, top, top + 0.35));
  Outline lid = {{0, top + 0.35}, {radius + 0.7, top + 0.35}, {radius + 0.7, top + 0.7}};
  for (const Vector2d& p : arc({0, top + 0.7}, {radius - 0.3, 0.45}, 0, pi / 2, made.steps(4))) lid.push_back(p);
  lid.back() = {0, top + 1.15};
  add("hatch lid", lid);
  for (int i = 0; i < bolts; ++i) {
    const double angle = 2 * pi * (i + 0.5) / bolts, at = radius + 0.28;
    made.add("bolt", moved(turned({{0, 0}, {0.2, 0}, {0.2, 0.35}, {0, 0.35}}, made.steps(8)),
                           {x + at * std::cos(angle), top + 0.65, at * std::sin(angle)}));
  }
}

void add_fittings(Assembler& made) {
  // A pipe out of the front cap with a flange and a hand wheel; a gauge; two lifting eyes.
  const Path pipe = {{38, 4, 0}, {38.6, 3, 0}, {38.6, 1.6, 0}};
  made.add("pipe", rod(pipe, 0.5, made.steps(12)));
  made.add("pipe flange", moved(turned({{0, 1.3}, {0.9, 1.3}, {0.9, 1.7}, {0, 1.7}}, made.steps(16)), {38.6, 0, 0}));
  made.add("valve", moved(about(0, turned({{0, 0}, {0.2, 0}, {0.2, 1}, {0, 1}}, made.steps(10))), {38.9, 2.4, 0}));
  made.add("hand wheel", moved(about(0, ring(0.9, 0.12, made.steps(20), made.steps(6))), {39.8, 2.4, 0}));
  made.add("gauge stem",
           moved(turned({{0, 13.8}, {0.25, 13.8}, {0.25, 15.3}, {0, 15.3}}, made.steps(10)), {21.5, 0, 0}));
  made.add("gauge",
           moved(about(2, turned({{0, -0.3}, {0.9, -0.3}, {0.9, 0.3}, {0, 0.3}}, made.steps(20))), {21.5, 15.9, 0}));
  // A glass beside the shell tells the level.
  made.add("level glass", rod({{30, 4.5, 6.3}, {30, 11.5, 6.3}}, 0.25, made.steps(10)));
  for (const double y : {4.5, 11.5})
    made.add("level joint", moved(ball({0.5, 0.5, 1.4}, made.steps(10)), {30, y, 5.6}));
  for (const double x : {9.0, 31.0}) {
    made.add("eye", moved(about(2, ring(0.8, 0.22, made.steps(16), made.steps(6))), {x, kAxis + kRadius + 1.1, 0}));
  }
}

}  // namespace

Assembled tank(double detail) {
  Assembler made(detail);
  add_shell(made);
  add_feet(made);
  add_hatch(made, 14.5, 2.6, 12);
  add_hatch(made, 26.5, 1.7, 10);
  add_fittings(made);
  made.add("name plate", moved(slab({4, 1.8, 0.3}, 0.1), {20, kAxis, 6}));
  return made.assembled();
}

}  // namespace swage::test
