#include <algorithm>
#include <array>
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

constexpr double kFrontAxle = 14, kRearAxle = 59, kAxleHeight = 7, kWheelSide = 12.6, kWheelRadius = 7;

/// What the body is like at a place along x.
struct Station {
  double x, bottom, top, half_width, corner;
};

// Nose, bonnet, cockpit, tail. Between the places of the cockpit all is straight.
constexpr std::array<Station, 10> kBody = {{{1, 8.5, 12, 4.5, 1.5},
                                            {2, 6.5, 15, 7.2, 3.0},
                                            {5, 5.5, 17.5, 9.2, 3.6},
                                            {12, 5, 19.2, 10.4, 3.8},
                                            {24, 5, 20.5, 11, 3.8},
                                            {27, 5, 9, 11, 1.2},
                                            {50, 5, 9, 11, 1.2},
                                            {53, 5, 19.6, 11, 3.8},
                                            {66, 6, 17.5, 9.6, 3.8},
                                            {72, 8, 12, 5.5, 1.8}}};

double smooth(double a, double b, double part) { return a + (b - a) * part * part * (3 - 2 * part); }

Mesh body(const Assembler& made) {
  std::vector<Path> rings;
  const auto add = [&](const Station& at) {
    Path points;
    for (const Vector2d& p : rounded_rectangle({2 * at.half_width, at.top - at.bottom}, at.corner, made.steps(8))) {
      points.emplace_back(at.x, (at.top + at.bottom) / 2 + p[1], p[0]);
    }
    rings.push_back(points);
  };
  add(kBody.front());
  for (size_t i = 1; i < kBody.size(); ++i) {
    const Station &from = kBody[i - 1], &to = kBody[i];
    const int steps = made.steps(std::clamp(static_cast<int>(to.x - from.x), 3, 8));
    for (int k = 1; k <= steps; ++k) {
      const double part = static_cast<double>(k) / steps;
      add({from.x + (to.x - from.x) * part, smooth(from.bottom, to.bottom, part), smooth(from.top, to.top, part),
           smooth(from.half_width, to.half_width, part), smooth(from.corner, to.corner, part)});
    }
  }
  return loft(rings);
}

Outline tyre_profile(const Assembler& made) {
  Outline profile = rounded_rectangle({2.6, 4}, 1, made.steps(4));
  for (Vector2d& point : profile) point[0] += kWheelRadius - 1.3;
  return profile;
}

/// A dish with a round rim, its outer side towards +y.
Outline rim_profile(const Assembler& made) {
  Outline profile = {{0, -1.2}};
  for (const Vector2d& p : cut({{1.2, -1.2}, {4.4, -1.6}}, made.steps(2))) profile.push_back(p);
  for (const Vector2d& p : arc({4.4, 1.2}, {0.35, 0.35}, 0, pi, made.steps(5))) profile.push_back(p);
  for (const Vector2d& p : cut({{3.4, 0.4}, {1.2, 0.6}}, made.steps(3))) profile.push_back(p);
  profile.emplace_back(0, 0.6);
  return profile;
}

Outline cap_profile(const Assembler& made) {
  Outline profile = {{0, 0.4}};
  const Outline dome = arc({0, 0.4}, {2, 1.3}, 0, pi / 2, made.steps(5));
  profile.insert(profile.end(), dome.begin(), dome.end() - 1);
  profile.emplace_back(0, 1.7);
  return profile;
}

/// A band over a wheel, with a lip before and behind.
Mesh mudguard(const Assembler& made) {
  Outline outline = arc({0, 0}, {8.6, 8.6}, 0.05 * pi, 0.93 * pi, made.steps(24));
  const Outline inner = arc({0, 0}, {7.8, 7.8}, 0.93 * pi, 0.05 * pi, made.steps(24));
  outline.insert(outline.end(), inner.begin(), inner.end());
  return pulled(outline, 5, made.steps(2));
}

void add_wheels(Assembler& made) {
  const int around = made.steps(48);
  for (const auto& [end, x] : {std::pair{"front", kFrontAxle}, {"rear", kRearAxle}}) {
    const auto at = [x = x](const Mesh& about_y) { return moved(about(2, about_y), {x, kAxleHeight, kWheelSide}); };
    const auto add = [&, end = end](const std::string& name, const Outline& profile) {
      made.add_mirrored(name + " " + end, at(turned(profile, around)));
    };
    add("tyre", tyre_profile(made));
    add("rim", rim_profile(made));
    add("cap", cap_profile(made));
    made.add_mirrored(std::string("mudguard ") + end, moved(mudguard(made), {x, kAxleHeight, kWheelSide - 0.3}));
    // As wide as the rim's flat middle, whose edge it meets vertex by vertex.
    const double half = kWheelSide - 1.2;
    made.add(std::string("axle ") + end,
             moved(about(2, turned({{0, -half}, {1.2, -half}, {1.2, half}, {0, half}}, around)), {x, kAxleHeight, 0}));
  }
}

void add_seats(Assembler& made) {
  for (const double side : {-4.8, 4.8}) {
    // Cushion and back from the side.
    Outline outline = {{36, 9}, {44.5, 9}};
    const auto round = [&](const Vector2d& centre, double radius, double from, double to) {
      for (const Vector2d& p : arc(centre, {radius, radius}, from * pi, to * pi, made.steps(6))) outline.push_back(p);
    };
    round({47.4, 20}, 1.3, -0.06, 0.94);
    round({41.6, 13.2}, 1.4, 0, -0.5);
    round({36.8, 10.8}, 1.1, 0.5, 1);
    made.add("seat", moved(pulled(outline, 7.6, made.steps(3)), {0, 0, side}));
  }
}

void add_steering(Assembler& made) {
  const Eigen::Affine3d tilt = Translation3d(34.6, 17.5, 4.8) * AngleAxisd(0.9, Vector3d::UnitZ());
  made.add("steering wheel", placed(ring(2.9, 0.32, made.steps(32), made.steps(10)), tilt));
  made.add("steering column", placed(turned({{0, -9}, {0.4, -9}, {0.4, 0.3}, {0, 0.3}}, made.steps(16)), tilt));
}

void add_top(Assembler& made) {
  const double low = 19, high = 33.4;
  for (const auto& [foot, head] : {std::pair{26.0, 32.0}, {53.0, 48.0}}) {
    made.add_mirrored("pillar", rod({{foot, low, 9.8}, {head, high, 8.8}}, 0.55, made.steps(12)));
  }
  Mesh roof = pulled(rounded_rectangle({22, 20}, 3.4, made.steps(6)), 1.6, made.steps(2));
  roof = moved(about(0, roof), {40, high + 0.8, 0});
  made.add("roof", roof);
  const double angle = std::atan2(high - low, 6.0);
  made.add("windscreen", placed(slab({15.2, 0.5, 18.2}, 0.1),
                                Translation3d(29, (low + high) / 2, 0) * AngleAxisd(angle, Vector3d::UnitZ())));
}

void add_lights(Assembler& made) {
  // A dome towards -x, and a ring around it.
  const int around = made.steps(32);
  Outline lamp = {{0, -1.5}, {2, -0.6}};
  for (const Vector2d& p : arc({0, 0}, {2, 0.9}, 0, pi / 2, made.steps(6))) lamp.push_back(p);
  lamp.back() = {0, 0.9};
  const auto forward = [&](const Mesh& about_y) {
    Mesh mesh = about(0, about_y);
    mesh.positions.col(0) *= -1;
    mesh.triangles.col(1).swap(mesh.triangles.col(2));
    return mesh;
  };
  made.add_mirrored("head light", moved(forward(turned(lamp, around)), {3.2, 16.5, 7.6}));
  made.add_mirrored("head light ring", moved(forward(ring(2.05, 0.35, around, made.steps(10))), {3.2, 16.5, 7.6}));
  made.add_mirrored("tail light", moved(ball({0.9, 1.2, 1.2}, made.steps(16)), {70.6, 12.5, 5.5}));
}

}  // namespace

Assembled car(double detail) {
  Assembler made(detail);
  made.add("body", body(made));
  made.add_mirrored("door", moved(slab({25, 10, 1}, 0.25), {38.5, 14, 10.8}));
  add_wheels(made);
  add_seats(made);
  add_steering(made);
  add_top(made);
  add_lights(made);
  made.add_mirrored("mirror", moved(ball({0.8, 1.3, 1.5}, made.steps(16)), {28.5, 20.6, 11.6}));
  made.add("bumper", rod({{2.2, 7, -13}, {0.8, 7, -11.5}, {0.6, 7, 11.5}, {2.2, 7, 13}}, 0.7, made.steps(12)));
  return made.assembled();
}

}  // namespace swage::test
