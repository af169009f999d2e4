// Candelabrum, phone, camera and wrench.
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

Outline disc(double radius, double low, double high) { return {{0, low}, {radius, low}, {radius, high}, {0, high}}; }

/// Points of the plane of x and y.
void append(Path& path, const Outline& outline) {
  for (const Vector2d& p : outline) path.emplace_back(p[0], p[1], 0);
}

/// Pan, cup, candle and flame, with a bead below.
void add_candle(Assembler& made, const Vector3d& at) {
  const int around = made.steps(12);
  const auto add = [&](const std::string& name, const Mesh& mesh) { made.add(name, moved(mesh, at)); };
  add("bead", moved(ball({0.9, 0.7, 0.9}, around), {0, -0.6, 0}));
  add("pan", turned({{0, 0}, {1.5, 0}, {3.4, 0.8}, {3.4, 1.1}, {1.5, 0.5}, {0, 0.5}}, around));
  add("cup", turned({{0, 0.4}, {1, 0.4}, {1.6, 1.8}, {1.7, 3}, {0, 3}}, around));
  add("candle", turned(disc(1.1, 2.5, 12), around));
  Outline flame = {{0, 12.3}, {0.5, 13}, {0.6, 13.8}, {0.35, 15}, {0, 16.4}};
  add("flame", turned(flame, around));
}

}  // namespace

Assembled candelabrum(double detail) {
  Assembler made(detail);
  const int around = made.steps(20);
  // A foot and a stem of turned parts, four arms to each side, candles upon them.
  made.add("foot",
           moved(turned({{0, 0}, {12.5, 0}, {12.5, 1}, {9, 2.2}, {4, 3.4}, {2.4, 5}, {0, 5}}, around), {40, 0, 0}));
  made.add("foot ring", moved(ring(12, 0.5, around, made.steps(8)), {40, 1.2, 0}));
  made.add("foot bead", moved(ring(4, 0.4, around, made.steps(8)), {40, 3.4, 0}));
  for (int i = 0; i < 14; ++i) {
    const double size = i % 3 == 0 ? 2.2 : i % 3 == 1 ? 1.4 : 1.1;
    made.add("knop", moved(ball({size, 1.7, size}, made.steps(16)), {40, 6 + 3.0 * i, 0}));
  }
  made.add("stem", moved(turned(disc(0.9, 4, 47), made.steps(12)), {40, 0, 0}));
  for (int i = 0; i < 4; ++i) {
    const double reach = 9.0 * (i + 1), low = 34 - 7.0 * i, top = 45;
    for (const double side : {-1.0, 1.0}) {
      Path arm;
      append(arm, arc({40, top}, {side * reach, top - low}, -pi / 2, 0, made.steps(16)));
      made.add("arm", rod(arm, 0.7, made.steps(8)));
      made.add("arm leaf",
               moved(ball({1.1, 1.1, 0.6}, made.steps(10)), {40 + side * reach * 0.72, top - (top - low) * 0.7, 0}));
      add_candle(made, {40 + side * reach, top + 1, 0});
      if (i == 3) continue;
      made.add("drop", moved(ball({0.5, 1.1, 0.5}, made.steps(10)), {40 + side * reach, top - 1.8, 0}));
    }
  }
  add_candle(made, {40, 48, 0});
  made.add("stem ring", moved(ring(1.4, 0.5, made.steps(16), made.steps(8)), {40, 46.8, 0}));
  made.add("stem cup", moved(turned({{0, 44}, {1, 44}, {1.8, 47}, {0, 47}}, made.steps(16)), {40, 0, 0}));
  return made.assembled();
}

Assembled phone(double detail) {
  Assembler made(detail);
  const int around = made.steps(40);
  // A body on four feet, a dial in front, a cradle with the handset across, along x.
  std::vector<Path> rings;
  for (int k = 0; k <= made.steps(24); ++k) {
    const double part = static_cast<double>(k) / made.steps(24), in = 1 - 0.45 * std::pow(part, 1.5);
    Path points;
    for (const Vector2d& p : rounded_rectangle({36 * in, 32 * in}, 5 * in, made.steps(8))) {
      points.emplace_back(p[0], 2 + 16 * part, p[1]);
    }
    rings.push_back(std::move(points));
  }
  made.add("body", loft(rings));
  made.add("base", moved(slab({42, 1.5, 42}, 0.5), {0, 2, 0}));
  for (const double x : {-15.0, 15.0}) {
    for (const double z : {-13.0, 13.0}) made.add("foot", moved(turned(disc(2, 0, 1.5), made.steps(24)), {x, 0, z}));
  }
  const Eigen::Affine3d face = Translation3d(0, 9.5, 14.4) * AngleAxisd(1.12, Vector3d::UnitX());
  made.add("dial", placed(turned(disc(7.5, -2, 0.4), around), face));
  made.add("dial ring", placed(ring(6.6, 0.7, around, made.steps(16)), face * Translation3d(0, 0.6, 0)));
  made.add("dial middle", placed(turned({{0, 0}, {3, 0}, {2.6, 1}, {0, 1.2}}, around), face));
  made.add("finger stop", placed(slab({0.6, 0.8, 2.4}, 0.1), face * Translation3d(4.6, 1, 4.6)));
  for (const double side : {-1.0, 1.0}) {
    made.add("cradle post", moved(turned(disc(1.2, 17, 21), made.steps(24)), {6 * side, 0, 0}));
    Path fork;
    append(fork, arc({0, 24}, {3.4, 3.2}, pi, 2 * pi, made.steps(20)));
    Mesh bow = quarter_turned(1, rod(fork, 0.7, made.steps(16)));
    made.add("cradle fork", moved(bow, {6 * side, 0, 0}));
    Outline bell = {{0, 0}, {4.4, 0}};
    for (const Vector2d& p : arc({0, 1.2}, {4.4, 4.2}, 0, pi / 2, made.steps(14))) bell.push_back(p);
    bell.back()[0] = 0;
    Mesh cup = turned(bell, around);
    cup.positions.col(1) *= -1;
    cup.triangles.col(1).swap(cup.triangles.col(2));
    made.add("handset end", moved(cup, {20 * side, 23, 0}));
    made.add("handset rim", moved(ring(4.4, 0.5, around, made.steps(12)), {20 * side, 22.4, 0}));
  }
  Path grip;
  append(grip, arc({0, 18}, {22, 8.8}, 0.1 * pi, 0.9 * pi, made.steps(40)));
  made.add("handset grip", rod(grip, 1.9, made.steps(28)));
  Path cord;
  for (int k = 0; k <= made.steps(160); ++k) {
    const double part = static_cast<double>(k) / made.steps(160), turn = 2 * pi * 11 * part;
    cord.emplace_back(-20 - 3.5 * std::sin(pi * part) + 0.9 * std::cos(turn), 18 - 15 * part + 0.9 * std::sin(turn),
                      2 - 16 * part);
  }
  made.add("cord", rod(cord, 0.35, made.steps(10)));
  made.add("cord plug", moved(ball({1.2, 1.2, 1.6}, made.steps(20)), {-20, 3, -14}));
  made.add("name plate", moved(slab({8, 2, 0.4}, 0.1), {0, 4, 15.8}));
  return made.assembled();
}

Assembled camera(double detail) {
  Assembler made(detail);
  const int around = made.steps(32);
  const auto forward = [&](const std::string& name, const Outline& profile, double x, double y) {
    made.add(name, moved(about(2, turned(profile, around)), {x, y, 0}));
  };
  const auto upward = [&](const std::string& name, const Outline& profile, double x, double z) {
    made.add(name, moved(turned(profile, around), {x, 0, z}));
  };
  // A body along x, the lens towards z.
  Outline shape = rounded_rectangle({60, 22}, 7, made.steps(6));
  made.add("body", moved(quarter_turned(0, pulled(shape, 28)), {30, 14, 11}));
  made.add("top plate", moved(slab({56, 3, 20}, 0.5), {30, 29, 11}));
  made.add("finder", moved(slab({16, 5.5, 14}, 1), {30, 32.5, 11}));
  made.add("finder window", moved(slab({9, 3, 1}, 0.2), {30, 32.5, 18}));
  made.add("flash shoe", moved(slab({6, 0.8, 7}, 0.2), {30, 35.6, 11}));
  forward("mount", disc(13, 21, 24), 30, 14.5);
  forward("barrel", disc(11.5, 24, 36), 30, 14.5);
  forward("focus ring", {{11, 27}, {12.4, 27}, {12.4, 32}, {11, 32}}, 30, 14.5);
  forward("tube", disc(10, 36, 46), 30, 14.5);
  forward("zoom ring", {{9.5, 38}, {10.8, 38}, {10.8, 43}, {9.5, 43}}, 30, 14.5);
  forward("hood", {{9, 46}, {10, 46}, {12.5, 56}, {11.5, 56}}, 30, 14.5);
  Outline glass = {{0, 47}};
  for (const Vector2d& p : arc({0, 47}, {8.8, 3}, 0, pi / 2, made.steps(5))) glass.push_back(p);
  glass.back()[0] = 0;
  forward("glass", glass, 30, 14.5);
  upward("shutter dial", disc(4, 30, 33), 48, 11);
  upward("shutter button", disc(1.6, 33, 34.5), 48, 11);
  upward("rewind", disc(3.4, 30, 33.4), 11, 11);
  made.add("rewind lever", moved(slab({7, 0.8, 1.6}, 0.2), {12, 34, 11}));
  upward("counter", disc(2, 30, 31.4), 55, 14);
  made.add("wind lever", moved(slab({9, 1, 2.6}, 0.2), {53, 33, 7}));
  for (const double x : {0.8, 59.2}) {
    made.add("strap lug", moved(about(0, ring(1.4, 0.4, made.steps(16), made.steps(6))), {x, 24, 11}));
  }
  forward("self timer", disc(2, 21.5, 23), 9, 20);
  made.add("timer arm", moved(slab({1.6, 6, 0.8}, 0.2), {9, 17.5, 23}));
  forward("lamp", disc(1.5, 21.5, 22.6), 51, 22);
  made.add("grip", moved(ball({4, 11, 4}, made.steps(16)), {53, 13, 22}));
  for (const double x : {10.0, 50.0})
    made.add("screw", moved(about(2, turned(disc(1, 21.8, 22.5), made.steps(16))), {x, 5, 0}));
  made.add("eyepiece", moved(about(2, ring(2.6, 0.6, made.steps(24), made.steps(6))), {30, 32.5, 4}));
  upward("tripod bush", disc(3, -0.6, 1), 30, 11);
  made.add("back door", moved(slab({44, 20, 1}, 0.3), {30, 14, 0}));
  return made.assembled();
}

Assembled wrench(double detail) {
  Assembler made(detail);
  // The handle with its fixed jaw, its outline in the xz plane; then what moves.
  Outline outline;
  const auto append_arc = [&](const Vector2d& centre, const Vector2d& radii, double from, double to, int steps) {
    for (const Vector2d& p : arc(centre, radii, from * pi, to * pi, made.steps(steps))) outline.push_back(p);
  };
  append_arc({5, 0}, {5, 4}, 0.5, 1.5, 40);
  append_arc({36, -8}, {10, 5}, 0.5, 0.25, 14);
  append_arc({47, 0}, {10, 8.5}, 1.75, 1.98, 20);
  outline.insert(outline.end(), {{59.8, 0.2}, {59.8, 2.6}, {50, 2.6}, {50, 3.6}});
  append_arc({46, 1}, {6, 7.5}, 0.25, 0.8, 24);
  append_arc({36, 8}, {10, 5}, 1.75, 1.5, 14);
  made.add("handle", quarter_turned(0, pulled(outline, 4, made.steps(3))));
  Outline jaw = {{50.6, 3}, {59.8, 3}, {60, 6}};
  for (const Vector2d& p : arc({53, 5}, {6, 3.5}, 0.1 * pi, pi, made.steps(30))) jaw.push_back(p);
  made.add("moving jaw", quarter_turned(0, pulled(jaw, 3.4, made.steps(3))));
  Outline thread = {{0, -2.5}};
  for (int k = 0; k <= 10; ++k) thread.emplace_back(k % 2 == 0 ? 1.3 : 1.6, -2.5 + 0.5 * k);
  thread.emplace_back(0, 2.5);
  made.add("worm", moved(about(0, turned(thread, made.steps(40))), {47, 0, 3.6}));
  made.add("pin", moved(turned(disc(0.8, -2.5, 2.5), made.steps(60)), {44, 0, 1}));
  return made.assembled();
}

}  // namespace swage::test
