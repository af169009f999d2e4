// A church and a fountain.
#include <cmath>
#include <numbers>

#include "resize_models.h"

namespace swage::test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

constexpr int kDrops = 59, kPeople = 100;

Mesh block(const Vector3d& low, const Vector3d& high) { return moved(slab(high - low, 0.15), (low + high) / 2); }

/// A window's outline: a half disc upon a rectangle, from the origin upwards.
Outline arched(double width, double height, int steps) {
  Outline outline = {{-width / 2, 0}, {width / 2, 0}};
  for (const Vector2d& p : arc({0, height}, {width / 2, width / 2}, 0, pi, steps)) outline.push_back(p);
  return outline;
}

/// A window with its sill, on a wall that faces -z or z, or ±x where `across`.
void add_window(Assembler& made, const Vector3d& at, double width, double height, bool across = false) {
  Mesh glass = pulled(arched(width, height, made.steps(16)), 0.8),
       sill = moved(slab({width + 0.8, 0.5, 1.2}, 0.1), {0, -0.25, 0});
  if (across) {
    glass = quarter_turned(1, glass);
    sill = quarter_turned(1, sill);
  }
  made.add("window", moved(glass, at));
  made.add("sill", moved(sill, at));
}

/// A house's outline, pulled along x.
Mesh gabled(double low_x, double high_x, double half_width, double eaves, double ridge) {
  const Outline outline = {{-half_width, eaves}, {half_width, eaves}, {0, ridge}};
  return moved(quarter_turned(1, pulled(outline, high_x - low_x, 4)), {(low_x + high_x) / 2, 0, 0});
}

void add_pillar(Assembler& made, const Vector3d& foot, double height, double radius) {
  Outline profile = {{0, 0}, {1.4 * radius, 0}};
  for (const Vector2d& p : arc({1.1 * radius, 0.4}, {0.3 * radius, 0.4}, 0, pi / 2, made.steps(3)))
    profile.push_back(p);
  for (const Vector2d& p : cut({{radius, 1}, {0.85 * radius, height - 1}}, made.steps(4))) profile.push_back(p);
  for (const Vector2d& p : arc({1.1 * radius, height - 0.4}, {0.3 * radius, 0.4}, -pi / 2, 0, made.steps(3))) {
    profile.push_back(p);
  }
  profile.insert(profile.end(), {{1.4 * radius, height}, {0, height}});
  made.add("pillar", moved(turned(profile, made.steps(20)), foot));
}

Mesh dome(const Assembler& made, double radius, double rise, int around) {
  Outline profile = {{0, 0}};
  for (const Vector2d& p : arc({0, 0}, {radius, rise}, 0, pi / 2, made.steps(12))) profile.push_back(p);
  profile.back() = {0, rise};
  return turned(profile, made.steps(around));
}

Mesh spike(const Assembler& made, double radius, double height) {
  return turned({{0, 0}, {radius, 0}, {radius * 0.5, height * 0.4}, {0, height}}, made.steps(16));
}

/// Head, body, two arms, two legs, a hat.
void add_person(Assembler& made, const Vector3d& at, double size) {
  const auto add = [&](const std::string& name, Mesh mesh) {
    mesh.positions *= size;
    made.add(name, moved(mesh, at));
  };
  add("head", moved(ball({0.35, 0.42, 0.35}, made.steps(8)), {0, 3.6, 0}));
  add("body", moved(turned({{0, 1.5}, {0.5, 1.5}, {0.6, 2.9}, {0.2, 3.2}, {0, 3.2}}, made.steps(8)), {0, 0, 0}));
  for (const double side : {-1.0, 1.0}) {
    add("arm", rod({{0.55 * side, 3, 0}, {0.8 * side, 2.2, 0.1}, {0.7 * side, 1.5, 0.3}}, 0.14, made.steps(6)));
    add("leg", rod({{0.25 * side, 1.6, 0}, {0.3 * side, 0.8, 0}, {0.3 * side, 0, 0}}, 0.2, made.steps(6)));
  }
  add("hat", moved(turned({{0, 0}, {0.5, 0}, {0.3, 0.15}, {0.25, 0.4}, {0, 0.4}}, made.steps(8)), {0, 3.85, 0}));
}

}  // namespace

Assembled church(double detail) {
  Assembler made(detail);
  // Nave and aisles along x, the tower at the low end, the choir at the high one, a transept across.
  made.add("ground", block({0, 0, -25}, {80, 1, 25}));
  made.add("nave", block({14, 1, -9}, {66, 20, 9}));
  made.add("nave roof", gabled(13, 67, 10, 20, 29));
  for (const double side : {-1.0, 1.0}) {
    made.add("aisle", block({16, 1, side * 12.5 - 3.5}, {64, 11, side * 12.5 + 3.5}));
    made.add("aisle roof", gabled(16, 64, 3.8, 11, 13.5));
    made.add("transept", block({44, 1, side * 16 - 8}, {54, 18, side * 16 + 8}));
  }
  made.add("apse", moved(turned({{0, 0}, {8.5, 0}, {8.5, 15}, {0, 15}}, made.steps(48)), {66, 1, 0}));
  made.add("apse dome", moved(dome(made, 9, 6, 48), {66, 16, 0}));
  made.add("tower", block({3, 1, -6}, {15, 34, 6}));
  made.add("belfry ledge", block({2, 34, -7}, {16, 35.5, 7}));
  made.add("belfry", block({4, 35.5, -5}, {14, 41, 5}));
  made.add("tower dome", moved(dome(made, 5.5, 7, 40), {9, 41, 0}));
  made.add("ball", moved(ball({0.8, 0.8, 0.8}, made.steps(16)), {9, 48.6, 0}));
  made.add("cross", block({8.8, 49, -0.2}, {9.2, 52, 0.2}));
  made.add("cross arm", block({8.8, 50.6, -0.9}, {9.2, 51, 0.9}));
  made.add("rose", moved(about(0, ring(2.6, 0.4, made.steps(40), made.steps(10))), {2.9, 26, 0}));
  for (int i = 0; i < 6; ++i) {
    const double angle = pi * i / 6;
    const Vector3d out(0, 2.6 * std::cos(angle), 2.6 * std::sin(angle));
    made.add("rose bar", rod({Vector3d(2.9, 26, 0) - out, Vector3d(2.9, 26, 0) + out}, 0.15, made.steps(8)));
  }
  made.add("door", moved(quarter_turned(1, pulled(arched(4, 5, made.steps(20)), 0.8)), {2.9, 1, 0}));
  for (int step = 0; step < 3; ++step)
    made.add("step", block({0.4 + 0.6 * step, 1, -4.0 + step}, {3, 1.4 + 0.3 * step, 4.0 - step}));
  for (const double side : {-1.0, 1.0}) {
    for (int i = 0; i < 7; ++i) add_window(made, {19.0 + 4 * i + (i > 5 ? 16 : 0), 13.4, side * 9}, 1.6, 3.4);
    for (int i = 0; i < 6; ++i) add_window(made, {19.5 + 4.2 * i, 3.5, side * 16}, 1.8, 4);
    for (int i = 0; i < 4; ++i)
      made.add("buttress", block({17.0 + 7.5 * i, 1, side * 16.8 - 1}, {18.2 + 7.5 * i, 9, side * 16.8 + 1}));
    add_window(made, {9, 20, side * 6}, 2, 5);
    for (int i = 0; i < 5; ++i) add_pillar(made, {20.0 + 9 * i, 1, side * 21}, 8, 0.7);
    made.add("beam", block({18, 9, side * 21 - 1.2}, {58, 10.2, side * 21 + 1.2}));
    for (const double x : {3.0, 15.0}) made.add("pinnacle", moved(spike(made, 1, 5), {x, 35.5, side * 6}));
    for (const double x : {45.0, 53.0}) made.add("pinnacle", moved(spike(made, 1, 6), {x, 17.8, side * 23}));
    for (const double x : {46.5, 49.0})
      made.add("band", block({x - 0.2, 1, side * 24 - 0.3}, {x + 2, 17, side * 24 + 0.3}));
  }
  for (int i = 0; i < 12; ++i) {
    const double angle = -0.42 * pi + 0.84 * pi * i / 11;
    add_pillar(made, {66 + 8.7 * std::cos(angle), 1, 8.7 * std::sin(angle)}, 15, 0.5);
  }
  return made.assembled();
}

Assembled fountain(double detail) {
  Assembler made(detail);
  made.add("ground", block({0, 0, 0}, {50, 0.8, 38}));
  const Vector3d middle(25, 0.8, 19);
  const auto basin = [&](const std::string& name, double radius, double low, double depth) {
    Outline profile = {{0, 0.25 * depth}};
    for (const Vector2d& p : arc({0, depth}, {radius, depth}, -pi / 2 + 0.15, 0, made.steps(10))) profile.push_back(p);
    profile.front()[1] = profile[1][1];
    profile.insert(profile.end(), {{radius + 0.5, depth}, {radius + 0.5, depth + 0.5}, {radius - 0.5, depth + 0.5}});
    for (const Vector2d& p : arc({0, depth}, {radius - 0.5, 0.6 * depth}, 0, -pi / 2, made.steps(8)))
      profile.push_back(p);
    profile.back() = {0, 0.4 * depth};
    made.add(name, moved(turned(profile, made.steps(56)), middle + Vector3d(0, low, 0)));
  };
  basin("lower basin", 10, 0, 2.2);
  basin("middle basin", 5.5, 8, 1.6);
  basin("upper basin", 3, 14, 1.2);
  for (const auto& [low, high] : {std::pair{0.8, 9.0}, {9.0, 15.0}})
    add_pillar(made, middle + Vector3d(0, low, 0), high - low, 1.2);
  made.add("jet", moved(turned({{0, 0}, {0.4, 0}, {0.25, 3}, {0, 6}}, made.steps(16)), middle + Vector3d(0, 15, 0)));
  // Drops off the rims of the basins; a crowd around.
  for (int i = 0; i < kDrops; ++i) {
    const double angle = 2 * pi * i / 24, part = (i / 24 + 0.5) / 4;
    const double radius = 6 + 2 * part, height = 9.5 - 7 * part * part;
    made.add("drop", moved(ball({0.14, 0.25, 0.14}, made.steps(6)),
                           middle + Vector3d(radius * std::cos(angle), height, radius * std::sin(angle))));
  }
  for (int i = 0; i < kPeople; ++i) {
    // Golden angles keep them apart.
    const double angle = i * pi * (3 - std::sqrt(5.0));
    const double out = 1 + 0.28 * std::pow(static_cast<double>(i) / kPeople, 0.6);
    const double x = 25 + 17.5 * out * std::cos(angle), z = 19 + 12.8 * out * std::sin(angle);
    add_person(made, {x, 0.8, z}, 0.8 + 0.05 * (i % 5));
  }
  return made.assembled();
}

}  // namespace swage::test
