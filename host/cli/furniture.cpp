#include "furniture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

namespace swage::cli {
namespace {

using Eigen::Vector3d;
using Cell = std::array<int, 3>;

// A chair is first built of blocks on a grid, whose surface is closed and manifold by construction, and then bent by
// smooth maps. Lengths in metres; x and z run from the middle of the seat, y from the floor.
constexpr double kLeg = 0.0435;                         // Thickness of legs and posts: three cells.
constexpr double kCore = 0.42 * kLeg;                   // Its middle cell, which slats and stretchers go on.
constexpr double kRim = 0.016;                          // How far the seat stands out over the legs.
constexpr double kBetweenX = 0.330, kBetweenZ = 0.308;  // Between the legs.
constexpr double kSeatBottom = 0.430, kSeatTop = 0.462;
constexpr double kGap = 0.052, kSlat = 0.062, kCrest = 0.080, kFirstGap = 0.104, kTip = 0.015;
constexpr double kTop = kSeatTop + kFirstGap + 2 * (kSlat + kGap) + kCrest + kTip;
constexpr double kLegX = kBetweenX / 2 + kLeg / 2, kLegZ = kBetweenZ / 2 + kLeg / 2;  // Axes of the legs.
constexpr double kHalfX = kBetweenX / 2 + kLeg + kRim, kHalfZ = kBetweenZ / 2 + kLeg + kRim;

struct Run {
  double length;
  int cells;
};

/// Grid planes along one axis, and where each run of cells begins.
struct Axis {
  std::vector<double> planes;
  std::vector<int> begins{0};

  Axis(double start, const std::vector<Run>& runs) : planes{start} {
    for (const Run& run : runs) {
      const double from = planes.back();
      for (int i = 1; i <= run.cells; ++i) planes.push_back(from + run.length * i / run.cells);
      begins.push_back(begins.back() + run.cells);
    }
  }
};

// The runs by name, so that blocks read as a carpenter would say them.
enum Across { rim_low, leg_low, leg_low_core, leg_low_end, gap, leg_high, leg_high_core, leg_high_end, rim_high };
enum Upright { leg_below, stretcher, leg_above, seat, gap_1, slat_1, gap_2, slat_2, gap_3, crest, tip };

Axis across(double half, double between_legs, int cells_between) {
  const Run rim{kRim, 1}, side{(kLeg - kCore) / 2, 1}, core{kCore, 1};
  return {-half, {rim, side, core, side, {between_legs, cells_between}, side, core, side, rim}};
}

struct Grid {
  Axis x = across(kHalfX, kBetweenX, 16);
  Axis y{0,
         {{0.14, 8},
          {0.032, 2},
          {kSeatBottom - 0.172, 14},
          {kSeatTop - kSeatBottom, 2},
          {kFirstGap, 6},
          {kSlat, 4},
          {kGap, 3},
          {kSlat, 4},
          {kGap, 3},
          {kCrest, 5},
          {kTip, 1}}};
  Axis z = across(kHalfZ, kBetweenZ, 15);

  Vector3d point(const Cell& node) const {
    auto at = [](const Axis& axis, int i) { return axis.planes[static_cast<size_t>(i)]; };
    return {at(x, node[0]), at(y, node[1]), at(z, node[2])};
  }
};

struct Interval {
  int first, end;
};

/// The cells of runs `from` to `to`.
Interval cells(const Axis& axis, int from, int to) {
  return {axis.begins[static_cast<size_t>(from)], axis.begins[static_cast<size_t>(to) + 1]};
}
Interval cells(const Axis& axis, int run) { return cells(axis, run, run); }

/// A set of cells, and the surface around it.
class Blocks {
 public:
  void fill(Interval x, Interval y, Interval z) {
    for (int i = x.first; i < x.end; ++i) {
      for (int j = y.first; j < y.end; ++j) {
        for (int k = z.first; k < z.end; ++k) filled_[{i, j, k}] = true;
      }
    }
  }

  /// Corners of the quadrilaterals between a filled and an empty cell, counter-clockwise seen from the empty one.
  std::vector<std::array<Cell, 4>> surface() const {
    std::vector<std::array<Cell, 4>> quads;
    for (const auto& [cell, filled] : filled_) {
      for (size_t axis = 0; axis < 3; ++axis) {
        for (int side : {0, 1}) {
          Cell neighbour = cell;
          neighbour[axis] += side == 1 ? 1 : -1;
          if (!filled_.contains(neighbour)) quads.push_back(side_of(cell, axis, side));
        }
      }
    }
    return quads;
  }

 private:
  static std::array<Cell, 4> side_of(const Cell& cell, size_t axis, int side) {
    const size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    std::array<Cell, 4> quad{cell, cell, cell, cell};
    for (Cell& node : quad) node[axis] += side;
    quad[1][u] = quad[2][u] = cell[u] + 1;
    quad[2][v] = quad[3][v] = cell[v] + 1;
    if (side == 0) std::swap(quad[1], quad[3]);
    return quad;
  }

  std::map<Cell, bool> filled_;
};

Blocks chair_blocks(const Grid& grid) {
  Blocks blocks;
  for (const int x : {leg_low, leg_high}) {
    const Interval leg = cells(grid.x, x, x + 2), core = cells(grid.x, x + 1);
    blocks.fill(leg, cells(grid.y, leg_below, leg_above), cells(grid.z, leg_high, leg_high_end));
    blocks.fill(leg, cells(grid.y, leg_below, tip), cells(grid.z, leg_low, leg_low_end));
    blocks.fill(core, cells(grid.y, stretcher), cells(grid.z, gap));
  }
  blocks.fill(cells(grid.x, rim_low, rim_high), cells(grid.y, seat), cells(grid.z, rim_low, rim_high));
  for (const int y : {slat_1, slat_2, crest}) {
    blocks.fill(cells(grid.x, gap), cells(grid.y, y), cells(grid.z, leg_low_core));
  }
  return blocks;
}

double square(double x) { return x * x; }

double smooth_step(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// Away from the seat, legs and posts grow thinner, and their square section round.
Vector3d turned(const Vector3d& p) {
  const double below = std::max(0.0, kSeatBottom - p[1]), above = std::max(0.0, p[1] - kSeatTop);
  const double thickness = 1 - 0.24 * below / kSeatBottom - 0.20 * above / (kTop - kSeatTop);
  const double round = smooth_step((below + above) / 0.07);
  const double axis_x = std::copysign(kLegX, p[0]), axis_z = std::copysign(kLegZ, p[2]);
  const double u = (p[0] - axis_x) / (kLeg / 2), w = (p[2] - axis_z) / (kLeg / 2);
  // Slats and stretchers, which lie between the legs, stay square.
  const bool in_x = std::abs(u) < 1.001, in_z = std::abs(w) < 1.001;
  const double narrow_u = in_z ? std::sqrt(1 - round * w * w / 2) : 1;
  const double narrow_w = in_x ? std::sqrt(1 - round * u * u / 2) : 1;
  Vector3d q = p;
  if (in_x) q[0] = axis_x + thickness * narrow_u * (p[0] - axis_x);
  if (in_z) q[2] = axis_z + thickness * narrow_w * (p[2] - axis_z);
  return q;
}

/// The seat is hollowed, its rim rounded.
Vector3d carved(const Vector3d& p) {
  if (p[1] < kSeatBottom - 1e-9 || p[1] > kSeatTop + 1e-9) return p;
  const double up = (p[1] - kSeatBottom) / (kSeatTop - kSeatBottom);
  const double inward = 0.005 * square(2 * up - 1);
  Vector3d q = p;
  for (const auto& [axis, half] : {std::pair{0, kHalfX}, {2, kHalfZ}}) {
    if (std::abs(p[axis]) > half - 1e-9) q[axis] -= std::copysign(inward, p[axis]);
  }
  const double x = p[0] / kLegX, z = p[2] / kLegZ;
  if (std::abs(x) < 1 && std::abs(z) < 1) q[1] -= 0.010 * up * square((1 - x * x) * (1 - z * z));
  return q;
}

/// The back leans, its slats are bowed and arched, the legs are splayed, and the seat is rounded and wider in front.
Vector3d bent(const Vector3d& p) {
  const double below = std::max(0.0, kSeatBottom - p[1]), above = std::max(0.0, p[1] - kSeatTop);
  const double rise = above / (kTop - kSeatTop);
  const double inside = std::max(0.0, 1 - square(p[0] / (kBetweenX / 2)));
  const double x = p[0] / kHalfX, z = p[2] / kHalfZ;
  // Stretchers run straight from leg to leg below the rounded seat.
  const double round_z = below > 0 ? std::max(std::abs(z), kBetweenZ / 2 / kHalfZ) : z;
  Vector3d q = p;
  q[0] *= std::sqrt(1 - 0.10 * square(round_z)) * (1 + 0.07 * z) * (1 + 0.16 * below);
  q[2] *= std::sqrt(1 - 0.10 * x * x) * (1 + 0.16 * below);
  q[2] -= 0.14 * above + 0.30 * above * above + 0.025 * inside * smooth_step(above / 0.1);
  q[1] += 0.035 * inside * rise * rise;
  return q;
}

Vector3d shaped(const Vector3d& p) { return bent(carved(turned(p))); }

double smallest_angle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  auto at = [](const Vector3d& p, const Vector3d& q, const Vector3d& r) {
    return std::atan2((q - p).cross(r - p).norm(), (q - p).dot(r - p));
  };
  return std::min({at(a, b, c), at(b, c, a), at(c, a, b)});
}

/// Vertices numbered as they are first used.
class MeshBuilder {
 public:
  int vertex(const Grid& grid, const Cell& node) {
    const auto [at, fresh] = ids_.try_emplace(node, static_cast<int>(points_.size()));
    if (fresh) points_.push_back(shaped(grid.point(node)));
    return at->second;
  }

  /// Two triangles, along the diagonal that keeps their angles larger.
  void quad(int a, int b, int c, int d) {
    const auto worst = [&](int i, int j, int k, int l) {
      return std::min(smallest_angle(point(i), point(j), point(k)), smallest_angle(point(i), point(k), point(l)));
    };
    if (worst(b, c, d, a) > worst(a, b, c, d) + 1e-9) {
      triangles_.insert(triangles_.end(), {{b, c, d}, {b, d, a}});
    } else {
      triangles_.insert(triangles_.end(), {{a, b, c}, {a, c, d}});
    }
  }

  Mesh mesh() const {
    Mesh mesh{Positions(points_.size(), 3), Triangles(triangles_.size(), 3)};
    for (size_t i = 0; i < points_.size(); ++i) mesh.positions.row(static_cast<Eigen::Index>(i)) = points_[i];
    for (size_t i = 0; i < triangles_.size(); ++i) mesh.triangles.row(static_cast<Eigen::Index>(i)) = triangles_[i];
    return mesh;
  }

 private:
  const Vector3d& point(int i) const { return points_[static_cast<size_t>(i)]; }

  std::map<Cell, int> ids_;
  std::vector<Vector3d> points_;
  std::vector<Eigen::Vector3i> triangles_;
};

int nearest_vertex(const Mesh& mesh, const Vector3d& point) {
  Eigen::Index nearest = 0;
  (mesh.positions.rowwise() - point.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
  return static_cast<int>(nearest);
}

}  // namespace

Mesh chair() {
  const Grid grid;
  MeshBuilder builder;
  for (const std::array<Cell, 4>& quad : chair_blocks(grid).surface()) {
    std::array<int, 4> ids{};
    for (size_t i = 0; i < 4; ++i) ids[i] = builder.vertex(grid, quad[i]);
    builder.quad(ids[0], ids[1], ids[2], ids[3]);
  }
  return builder.mesh();
}

Gesture wider_and_lower(const Mesh& chair) {
  Gesture gesture;
  gesture.label = "wider_and_lower";
  auto handle = [&](const Vector3d& block_point, const Vector3d& by) {
    const int v = nearest_vertex(chair, shaped(block_point));
    gesture.add(v, chair.positions.row(v).transpose() + by);
  };
  constexpr double kWider = 0.09, kLower = 0.09;
  // A leg of three cells has no vertex on its axis: these are the outer ones beside it.
  const double x = kLegX + kCore / 2, z = kLegZ + kCore / 2;
  for (const double side : {-1.0, 1.0}) {
    for (const double front : {-1.0, 1.0}) {
      handle({side * x, 0, front * z}, {side * kWider, 0, 0});
      handle({side * kHalfX, kSeatTop, front * kHalfZ}, {side * kWider, -kLower, 0});
    }
    handle({side * x, kTop, -z}, {side * kWider, -1.5 * kLower, 0});
  }
  return gesture;
}

}  // namespace swage::cli
