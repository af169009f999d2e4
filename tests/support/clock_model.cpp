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

constexpr double kDialX = 25, kDialY = 83, kDialFront = 16, kDialRadius = 12;
constexpr int kDentils = 49, kTeeth = 49;  // Of a row.

Mesh bevelled_block(const Vector3d& low, const Vector3d& high, double bevel = 0.3) {
  return moved(slab(high - low, bevel), (low + high) / 2);
}

/// A turned part with its axis along z, at the dial's middle.
Mesh at_dial(const Mesh& about_y, double z) { return moved(about(2, about_y), {kDialX, kDialY, z}); }

void add_dial(Assembler& made) {
  const int around = made.steps(64);
  const double front = kDialFront;
  made.add("dial", at_dial(turned({{0, 0}, {kDialRadius, 0}, {kDialRadius, 0.8}, {0, 0.8}}, around), front));
  made.add("bezel", at_dial(ring(kDialRadius, 1, around, made.steps(14)), front + 0.6));
  made.add("inner ring", at_dial(ring(8, 0.22, around, made.steps(8)), front + 0.8));
  for (int minute = 0; minute < 60; ++minute) {
    const double angle = minute * pi / 30;
    const Vector2d out(std::sin(angle), std::cos(angle));
    const auto at = [&](double radius) {
      return Vector3d(kDialX + radius * out[0], kDialY + radius * out[1], front + 0.9);
    };
    if (minute % 5 == 0) {
      made.add("hour", rod({at(8.7), at(10.1)}, minute % 15 == 0 ? 0.45 : 0.3, made.steps(12)));
    }
    made.add("minute", moved(ball(Vector3d::Constant(0.2), made.steps(8)), at(10.7)));
  }
  const auto hand = [&](const std::string& name, double length, double width, double angle, double z) {
    const Outline outline = {
        {-width, -0.2 * length}, {width, -0.2 * length}, {width, 0.7 * length}, {0, length}, {-width, 0.7 * length}};
    made.add(name, placed(pulled(outline, 0.3),
                          Translation3d(kDialX, kDialY, front + z) * AngleAxisd(-angle, Vector3d::UnitZ())));
  };
  hand("hour hand", 6, 0.45, 10.15 / 12 * 2 * pi, 1.3);
  hand("minute hand", 9.2, 0.35, 9.0 / 60 * 2 * pi, 1.6);
  hand("second hand", 10, 0.12, 36.0 / 60 * 2 * pi, 1.9);
  made.add("boss", at_dial(turned({{0, 0.5}, {0.9, 0.5}, {0.9, 2.2}, {0.5, 2.5}, {0, 2.5}}, made.steps(20)), front));
}

void add_pendulum(Assembler& made) {
  const double bob = 27, z = 12;
  made.add("pendulum rod", rod({{kDialX, bob, z}, {kDialX, 69, z}}, 0.3, made.steps(12)));
  Outline lens = arc({0, 0}, {4.5, 1}, -pi / 2, pi / 2, made.steps(12));
  lens.front() = {0, -1};
  lens.back() = {0, 1};
  made.add("bob", moved(about(2, turned(lens, made.steps(48))), {kDialX, bob, z}));
  made.add("bob ring", moved(about(2, ring(4.5, 0.4, made.steps(48), made.steps(10))), {kDialX, bob, z}));
  made.add("nut", moved(ball({0.7, 0.5, 0.7}, made.steps(12)), {kDialX, bob - 5.2, z}));
}

/// A weight on a cord.
void add_weight(Assembler& made, double x, double height) {
  const double z = 10;
  Outline profile = {{0, 0}, {1.9, 0}};
  const Outline shoulder = arc({1.5, 10}, {0.4, 0.4}, 0, pi / 2, made.steps(4));
  profile.insert(profile.end(), shoulder.begin(), shoulder.end());
  profile.insert(profile.end(), {{0.4, 10.4}, {0.4, 11}, {0, 11}});
  made.add("weight", moved(turned(profile, made.steps(24)), {x, height, z}));
  made.add("cord", rod({{x, height + 11, z}, {x, 69, z}}, 0.25, made.steps(8)));
}

void add_column(Assembler& made, const std::string& name, double x, double z, double low, double high, double radius) {
  const int around = made.steps(24);
  const double length = high - low;
  const Outline shaft = {{0, 1.2}, {radius, 1.2}, {radius, length - 1.2}, {0, length - 1.2}};
  made.add(name, moved(turned(shaft, around), {x, low, z}));
  made.add(name + " foot", moved(ring(radius * 0.8, radius * 0.5, around, made.steps(8)), {x, low + 0.9, z}));
  made.add(name + " head", moved(ring(radius * 0.7, radius * 0.5, around, made.steps(8)), {x, high - 0.9, z}));
}

void add_finial(Assembler& made, double x, double y, double size) {
  Outline vase = {{0, 0}, {0.9, 0}, {0.9, 0.3}, {0.4, 0.8}};
  const Outline belly = arc({0, 1.8}, {1.1, 1.1}, -0.37 * pi, 0.4 * pi, made.steps(10));
  vase.insert(vase.end(), belly.begin(), belly.end());
  vase.insert(vase.end(), {{0.15, 3.6}, {0, 3.8}});
  for (Vector2d& point : vase) point *= size;
  made.add("finial", moved(turned(vase, made.steps(24)), {x, y, 10}));
}

void add_case(Assembler& made) {
  for (const double x : {4.0, 46.0}) {
    for (const double z : {4.0, 18.0}) made.add("foot", moved(ball({2.6, 1.6, 2.6}, made.steps(16)), {x, 1.6, z}));
  }
  made.add("plinth", bevelled_block({0, 2.6, 0}, {50, 6, 22}));
  made.add("plinth step", bevelled_block({1, 6, 0.6}, {49, 8, 21.2}));
  made.add("base", bevelled_block({2, 8, 1}, {48, 15, 20}));
  made.add("base step", bevelled_block({1.2, 15, 0.6}, {48.8, 17, 21}));
  made.add("back", bevelled_block({4, 17, 1}, {46, 69, 2.5}));
  made.add("left side", bevelled_block({4, 17, 1}, {5.5, 69, 17}));
  made.add("right side", bevelled_block({44.5, 17, 1}, {46, 69, 17}));
  made.add("shelf", bevelled_block({1.2, 69, 0.6}, {48.8, 71, 21}));
  made.add("hood", bevelled_block({6, 71, 2}, {44, 98, kDialFront}));
  made.add("cornice", bevelled_block({1.5, 98, 0.8}, {48.5, 100, 20.5}));
  made.add("cornice step", bevelled_block({0.5, 100, 0.2}, {49.5, 102, 21.5}));
  for (const double x : {6.6, 43.4}) {
    add_column(made, "column", x, 17.5, 17, 69, 1.6);
    add_column(made, "hood column", x - (x < 25 ? 2 : -2), 17.5, 71, 98, 1.2);
  }
  // A gable above the hood, with a ring in its middle.
  made.add("pediment", moved(pulled({{-19, 0}, {19, 0}, {2, 9.2}, {-2, 9.2}}, 12), {25, 102, 9}));
  made.add("rosette", moved(about(2, ring(2.2, 0.7, made.steps(32), made.steps(12))), {25, 105.6, 15}));
  made.add("rosette middle", moved(ball({1.1, 1.1, 0.7}, made.steps(16)), {25, 105.6, 15}));
  for (int i = 0; i < kDentils; ++i) {
    const double x = 3 + 44.0 * i / (kDentils - 1);
    made.add("dentil", bevelled_block({x - 0.3, 96.6, 16.5}, {x + 0.3, 98, 19.8}, 0.1));
  }
  for (const double y : {7.0, 16.0}) {
    for (int i = 0; i < kTeeth; ++i) {
      const double x = 3 + 44.0 * i / (kTeeth - 1);
      made.add("tooth", bevelled_block({x - 0.3, y - 0.6, 20.5}, {x + 0.3, y + 0.6, 21.6}, 0.1));
    }
  }
  add_finial(made, 25, 110.8, 1.1);
  add_finial(made, 3.5, 102, 1.6);
  add_finial(made, 46.5, 102, 1.6);
}

}  // namespace

Assembled clock_of_parts(double detail) {
  Assembler made(detail);
  add_case(made);
  add_dial(made);
  add_pendulum(made);
  add_weight(made, 16, 30);
  add_weight(made, 34, 38);
  return made.assembled();
}

}  // namespace swage::test
