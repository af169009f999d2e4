#include "table_lamp.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace swage::bench {
namespace {

using Eigen::Vector2d;

constexpr int kAround = 32;

/// Radius and height from the middle of the base to that of the shade's top.
std::vector<Vector2d> profile() {
  struct Stretch {
    Vector2d end;
    int steps;
  };
  std::vector<Vector2d> points{{0, 0}};
  for (const auto& [end, steps] : std::vector<Stretch>{{{0.16, 0}, 6},
                                                       {{0.16, 0.03}, 1},
                                                       {{0.03, 0.06}, 6},
                                                       {{0.03, 0.36}, 40},
                                                       {{0.21, 0.36}, 8},
                                                       {{0.13, 0.62}, 12},
                                                       {{0, 0.62}, 5}}) {
    const Vector2d from = points.back();
    for (int i = 1; i <= steps; ++i) points.push_back(from + (end - from) * i / steps);
  }
  return points;
}

int nearest(const Mesh& mesh, const Eigen::RowVector3d& point) {
  Eigen::Index vertex = 0;
  (mesh.positions.rowwise() - point).rowwise().squaredNorm().minCoeff(&vertex);
  return static_cast<int>(vertex);
}

}  // namespace

Mesh table_lamp() {
  const std::vector<Vector2d> points = profile();
  const int rings = static_cast<int>(points.size()) - 2;  // Without the two ends, which are a vertex each.
  const int low = rings * kAround, high = low + 1;
  Mesh mesh{Positions(high + 1, 3), Triangles(2 * low, 3)};
  for (int ring = 0; ring < rings; ++ring) {
    const Vector2d& p = points[static_cast<size_t>(ring) + 1];
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2 * std::numbers::pi * (i + 0.5 * (ring % 2)) / kAround;
      mesh.positions.row(ring * kAround + i) << p[0] * std::cos(angle), p[1], p[0] * std::sin(angle);
    }
  }
  mesh.positions.row(low) << 0, points.front()[1], 0;
  mesh.positions.row(high) << 0, points.back()[1], 0;
  Eigen::Index t = 0;
  for (int i = 0; i < kAround; ++i) {
    const int next = (i + 1) % kAround, last = (rings - 1) * kAround;
    mesh.triangles.row(t++) << low, i, next;
    mesh.triangles.row(t++) << high, last + next, last + i;
    for (int ring = 0; ring + 1 < rings; ++ring) {
      const int a = ring * kAround, b = a + kAround;
      if (ring % 2 == 0) {
        mesh.triangles.row(t++) << a + i, b + i, a + next;
        mesh.triangles.row(t++) << a + next, b + i, b + next;
      } else {
        mesh.triangles.row(t++) << a + i, b + next, a + next;
        mesh.triangles.row(t++) << a + i, b + i, b + next;
      }
    }
  }
  return mesh;
}

Gesture taller(const Mesh& lamp) {
  Gesture gesture;
  gesture.label = "taller";
  for (const double side : {-1.0, 1.0}) {
    const int foot = nearest(lamp, {side * 0.16, 0, 0}), rim = nearest(lamp, {side * 0.13, 0.62, 0});
    gesture.add(foot, lamp.positions.row(foot).transpose());
    gesture.add(rim, lamp.positions.row(rim).transpose() + Eigen::Vector3d(0, 0.3, 0));
  }
  return gesture;
}

}  // namespace swage::bench
