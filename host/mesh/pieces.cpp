#include "pieces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "angle_rounding.h"
#include "measures.h"

namespace swage {
namespace {

using Eigen::Index;

/// Normals of any length; zero where a triangle has no area.
Positions certain_normals(const Positions& positions, const Triangles& triangles) {
  Positions normals = area_vectors(positions, triangles);
#pragma omp parallel for schedule(static)
  for (Index t = 0; t < triangles.rows(); ++t) {
    if (!has_area(positions, triangles.row(t))) normals.row(t).setZero();
  }
  return normals;
}

/// Of each side 1 where the surface goes on smoothly across it, 0 where it is cut; 2 where it ends.
std::vector<char> kinds_of_sides(const Positions& positions, const Triangles& triangles, const NextSides& next,
                                 double crease_angle) {
  const Positions normals = certain_normals(positions, triangles);
  // By how much normals may turn. Of the sine and the cosine, both: one alone cannot tell all angles apart.
  const double turn = std::min(std::numbers::pi - crease_angle + kAngleRounding, std::numbers::pi);
  const double sine = turn < std::numbers::pi ? std::sin(turn) : 0, cosine = std::cos(turn);
  const auto smooth = [&](int side, int other) {
    if (same_way(triangles, side, other)) return false;
    const Eigen::RowVector3d a = normals.row(side / 3), b = normals.row(other / 3);
    return !a.isZero(0) && !b.isZero(0) && a.cross(b).norm() * cosine <= a.dot(b) * sine;
  };
  std::vector<char> kinds(static_cast<size_t>(triangles.size()));
  const auto sides = static_cast<int>(triangles.size());
#pragma omp parallel for schedule(static)
  for (int side = 0; side < sides; ++side) {
    const int other = next.data()[side];
    const bool are_two = next.data()[other] == side;
    if (are_two && other < side) continue;  // The other tells of both.
    const char kind = other == side ? 2 : are_two && smooth(side, other) ? 1 : 0;
    kinds[static_cast<size_t>(side)] = kind;
    if (are_two) kinds[static_cast<size_t>(other)] = kind;
  }
  return kinds;
}

/// The corners at one vertex that see each other across smooth sides.
class Fan {
 public:
  Fan(const NextSides& next, const std::vector<char>& kinds) : next_(next), kinds_(kinds) {}

  /// Of the corner and all that it sees, work().
  template <typename Work>
  void each(int corner, const Work& work) const {
    int at = corner;
    do {
      work(at);
      at = across_side_before(at);
    } while (at >= 0 && at != corner);
    if (at >= 0) return;  // All around.
    while ((corner = across_own_side(corner)) >= 0) work(corner);
  }

 private:
  /// The corner of the next triangle; -1 where the side between is a cut.
  int across_side_before(int corner) const {
    const int side = previous_in_triangle(corner);
    return kinds_[static_cast<size_t>(side)] == 1 ? next_.data()[side] : -1;
  }
  int across_own_side(int corner) const {
    return kinds_[static_cast<size_t>(corner)] == 1 ? next_in_triangle(next_.data()[corner]) : -1;
  }

  const NextSides& next_;
  const std::vector<char>& kinds_;
};

/// Of each corner the first of its fan.
Triangles firsts_of_fans(const Triangles& triangles, const Lists& corners, const Fan& fan) {
  Triangles firsts(triangles.rows(), 3);
#pragma omp parallel for schedule(dynamic, 1024)
  for (int v = 0; v < corners.size(); ++v) {
    for (const int corner : corners[v]) firsts.data()[corner] = -1;
    for (const int first : corners[v]) {
      if (firsts.data()[first] < 0) fan.each(first, [&](int corner) { firsts.data()[corner] = first; });
    }
  }
  return firsts;
}

/// Instead of the first corner of its fan, each gets the fan's number. Returns the fans' first corners.
std::vector<int> number_fans(Triangles& fans) {
  std::vector<int> firsts;
  for (int corner = 0; corner < fans.size(); ++corner) {
    if (fans.data()[corner] != corner) continue;
    fans.data()[corner] = ~static_cast<int>(firsts.size());
    firsts.push_back(corner);
  }
  const auto corners = static_cast<int>(fans.size());
#pragma omp parallel for schedule(static)
  for (int corner = 0; corner < corners; ++corner) {
    int& fan = fans.data()[corner];
    if (fan >= 0) fan = ~fans.data()[fan];
  }
#pragma omp parallel for schedule(static)
  for (size_t i = 0; i < firsts.size(); ++i) fans.data()[firsts[i]] = static_cast<int>(i);
  return firsts;
}

/// Of each vertex whether a cut runs through it or ends there.
std::vector<char> vertices_on_cuts(const Lists& corners, const std::vector<char>& kinds) {
  std::vector<char> on_cut(static_cast<size_t>(corners.size()), 0);
#pragma omp parallel for schedule(static)
  for (int v = 0; v < corners.size(); ++v) {
    for (const int corner : corners[v]) {
      const auto own = static_cast<size_t>(corner), before = static_cast<size_t>(previous_in_triangle(corner));
      if (kinds[own] == 0 || kinds[before] == 0) on_cut[static_cast<size_t>(v)] = 1;
    }
  }
  return on_cut;
}

}  // namespace

Pieces cut_at_creases(const Positions& positions, const Triangles& triangles, const Lists& corners,
                      const NextSides& next, double crease_angle) {
  const std::vector<char> kinds = kinds_of_sides(positions, triangles, next, crease_angle);
  Pieces pieces{{{}, firsts_of_fans(triangles, corners, Fan(next, kinds))}, {}};
  const std::vector<int> firsts = number_fans(pieces.mesh.triangles);
  const std::vector<char> on_cut = vertices_on_cuts(corners, kinds);
  pieces.mesh.positions.resize(static_cast<Index>(firsts.size()), 3);
  pieces.on_cut.resize(firsts.size());
#pragma omp parallel for schedule(static)
  for (size_t i = 0; i < firsts.size(); ++i) {
    const int v = triangles.data()[firsts[i]];
    pieces.mesh.positions.row(static_cast<Index>(i)) = positions.row(v);
    pieces.on_cut[i] = on_cut[static_cast<size_t>(v)];
  }
  return pieces;
}

Pieces cut_at_creases(const Positions& positions, const Triangles& triangles, double crease_angle) {
  const Lists corners = corners_of_vertices(triangles, static_cast<int>(positions.rows()));
  return cut_at_creases(positions, triangles, corners, next_sides(triangles, corners), crease_angle);
}

}  // namespace swage
