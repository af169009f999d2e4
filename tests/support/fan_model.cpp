#include <cmath>
#include <numbers>

#include "resize_models.h"

namespace swage::test {
namespace {

using Eigen::AngleAxisd;
using Eigen::Translation3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

constexpr double kHeight = 47, kCage = 9.6;  // Of the cage's middle, and its radius.
constexpr int kWires = 132;                  // Of a half of the cage.

Mesh at_cage(const Mesh& about_y, double z) { return moved(about(2, about_y), {0, kHeight, z}); }

/// Radius and distance from the cage's middle plane, `part` from the rim to the middle.
Vector2d cage_at(double part) {
  const double angle = part * pi / 2;
  return {2 + (kCage - 2) * std::cos(angle), 3.6 * std::pow(std::sin(angle), 0.8)};
}

void add_cage(Assembler& made) {
  for (const double side : {-1.0, 1.0}) {
    for (int i = 0; i < kWires; ++i) {
      const double angle = 2 * pi * i / kWires;
      Path path;
      for (int k = 0; k <= made.steps(24); ++k) {
        const Vector2d at = cage_at(static_cast<double>(k) / made.steps(24));
        path.emplace_back(at[0] * std::cos(angle), kHeight + at[0] * std::sin(angle), side * at[1]);
      }
      made.add("wire", rod(path, 0.07, made.steps(6)));
    }
    for (const double part : {0.35, 0.7, 0.999}) {
      const Vector2d at = cage_at(part);
      made.add("cage ring", at_cage(ring(at[0], 0.12, made.steps(64), made.steps(6)), side * at[1]));
    }
  }
  made.add("cage rim", at_cage(ring(kCage, 0.4, made.steps(64), made.steps(10)), 0));
  made.add("badge", at_cage(turned({{0, 0}, {2.1, 0}, {2.1, 0.3}, {1.6, 0.6}, {0, 0.6}}, made.steps(40)), 3.4));
  made.add("back plate", at_cage(turned({{0, 0}, {2.1, 0}, {2.1, 0.4}, {0, 0.4}}, made.steps(40)), -3.9));
}

/// Pitched, thin, wider outwards.
Mesh blade(const Assembler& made, double angle) {
  std::vector<Path> rings;
  const int steps = made.steps(16);
  for (int k = 0; k <= steps; ++k) {
    const double part = static_cast<double>(k) / steps, radius = 1 + 7 * part, pitch = 0.7 - 0.35 * part;
    const double width = (1.2 + 2.6 * part) * std::sqrt(std::max(0.06, 1 - std::pow(part, 6)));
    Path points;
    for (const Vector2d& p : rounded_rectangle({2 * width, 0.24}, 0.1, made.steps(3))) {
      const Vector2d tilted(p[0] * std::cos(pitch), p[0] * std::sin(pitch) + p[1]);
      points.emplace_back(radius, tilted[0], tilted[1]);
    }
    rings.push_back(std::move(points));
  }
  return placed(loft(rings), Translation3d(0, kHeight, 0.4) * AngleAxisd(angle, Vector3d::UnitZ()));
}

void add_motor(Assembler& made) {
  const int around = made.steps(40);
  Outline housing = {{0, -9.5}};
  for (const Vector2d& p : arc({0, -6.5}, {2.6, 3}, -pi / 2 + 0.2, 0, made.steps(8))) housing.push_back(p);
  housing.front()[1] = housing[1][1];
  housing.insert(housing.end(), {{2.6, -4.2}, {2.2, -3.8}, {0, -3.8}});
  made.add("motor", at_cage(turned(housing, around), 0));
  made.add("shaft", at_cage(turned({{0, -3.9}, {0.35, -3.9}, {0.35, 1.2}, {0, 1.2}}, made.steps(20)), 0));
  Outline hub = {{0, -0.6}, {1.5, -0.6}};
  for (const Vector2d& p : arc({0, 0.6}, {1.5, 0.9}, 0, pi / 2, made.steps(6))) hub.push_back(p);
  hub.back()[0] = 0;
  made.add("hub", at_cage(turned(hub, around), 0.2));
  for (int i = 0; i < 5; ++i) made.add("blade", blade(made, pi / 2 + 2 * pi * i / 5));
  for (const double z : {-4.6, -5.2, -5.8, -6.4, -7.0, -7.6})
    made.add("cooling rib", at_cage(ring(2.6, 0.14, around, made.steps(6)), z));
  made.add("swivel knob",
           moved(turned({{0, 0}, {0.5, 0}, {0.6, 1}, {0, 1.2}}, made.steps(20)), {0, kHeight + 2.4, -6}));
}

void add_stand(Assembler& made) {
  const int around = made.steps(64);
  Outline base = {{0, 0}, {10, 0}};
  for (const Vector2d& p : arc({8.8, 0.9}, {1.2, 0.9}, 0, pi / 2, made.steps(8))) base.push_back(p);
  for (const Vector2d& p : cut({{8.8, 1.8}, {2.4, 2.6}}, made.steps(4))) base.push_back(p);
  for (const Vector2d& p : arc({2.4, 4}, {1.4, 1.4}, -pi / 2, -pi, made.steps(6))) base.push_back(p);
  base.insert(base.end(), {{1, 5}, {0, 5}});
  made.add("base", turned(base, around));
  made.add("base ring", moved(ring(9.2, 0.4, around, made.steps(10)), {0, 1.4, 0}));
  const auto pipe = [&](const std::string& name, double radius, double low, double high) {
    made.add(name, turned({{0, low}, {radius, low}, {radius, high}, {0, high}}, made.steps(32)));
  };
  pipe("outer pipe", 1, 4.6, 24);
  pipe("collar", 1.4, 22.5, 25);
  pipe("inner pipe", 0.7, 24, 37.8);
  pipe("neck", 1.3, 36, 37.2);
  made.add("clamp", moved(about(2, turned({{0, 0}, {0.6, 0}, {0.8, 1.2}, {0.3, 1.6}, {0, 1.6}}, made.steps(20))),
                          {0, 23.6, 1.2}));
  // From the pipe's top behind the cage to the motor.
  const Path bracket = {{0, 37, 0}, {0, 37.3, -1.8}, {0, 38, -4.2}, {0, 40, -6}, {0, 43, -6.6}, {0, 46, -6.6}};
  made.add("bracket", rod(bracket, 0.8, made.steps(20)));
  for (int i = 0; i < 5; ++i) {
    const double angle = pi / 2 + (i - 2) * 0.34;
    const Vector3d at(6 * std::cos(angle), 2.1, 6 * std::sin(angle));
    made.add("button", moved(turned({{0, 0}, {0.5, 0}, {0.45, 0.6}, {0, 0.7}}, made.steps(16)), at));
  }
  for (int i = 0; i < 8; ++i) {
    const double angle = 2 * pi * i / 8;
    made.add("pad", moved(turned({{0, -0.3}, {0.7, -0.3}, {0.7, 0.1}, {0, 0.1}}, made.steps(16)),
                          {8 * std::cos(angle), 0, 8 * std::sin(angle)}));
  }
}

}  // namespace

Assembled fan(double detail) {
  Assembler made(detail);
  add_cage(made);
  add_motor(made);
  add_stand(made);
  return made.assembled();
}

}  // namespace swage::test
