#include "pieces.h"

#include <algorithm>
#include <numeric>

#include "adjacency.h"
#include "measures.h"

namespace swage {
namespace {

// A dihedral angle that equals the crease angle up to rounding (radians) is not below it.
constexpr double kAngleRounding = 1e-9;

/// Corners, three a triangle, that share a vertex of a piece.
class Corners {
 public:
  explicit Corners(Eigen::Index triangle_count) : parents_(static_cast<size_t>(3 * triangle_count)) {
    std::iota(parents_.begin(), parents_.end(), 0);
  }
  void join(int a, int b) {
    const auto [low, high] = std::minmax({first(a), first(b)});
    parents_[static_cast<size_t>(high)] = low;
  }
  int first(int corner) {
    while (parents_[static_cast<size_t>(corner)] != corner) {
      int& parent = parents_[static_cast<size_t>(corner)];
      parent = parents_[static_cast<size_t>(parent)];
      corner = parent;
    }
    return corner;
  }

 private:
  std::vector<int> parents_;
};

/// Normals of any length; zero where a triangle has no area.
Positions certain_normals(const Positions& positions, const Triangles& triangles) {
  Positions normals = area_vectors(positions, triangles);
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    if (!has_area(positions, triangles.row(t))) normals.row(t).setZero();
  }
  return normals;
}

/// A side of a triangle: from corner k to corner k + 1.
struct Side {
  int from, to;  ///< Corners.
};

Side side_of(const Edges& edges, int triangle, int edge) {
  int k = 0;
  while (edges.triangle_edges(triangle, k) != edge) ++k;
  return {3 * triangle + k, 3 * triangle + (k + 1) % 3};
}

int vertex_of(const Triangles& triangles, int corner) { return triangles(corner / 3, corner % 3); }

Pieces assemble(const Positions& positions, const Triangles& triangles, Corners& corners,
                const std::vector<bool>& on_cut) {
  Pieces pieces{{{}, Triangles(triangles.rows(), 3)}, {}};
  std::vector<int> vertices, numbers(static_cast<size_t>(triangles.size()));
  for (int corner = 0; corner < triangles.size(); ++corner) {
    const int first = corners.first(corner);
    int& number = numbers[static_cast<size_t>(first)];
    if (first == corner) {
      number = static_cast<int>(vertices.size());
      vertices.push_back(vertex_of(triangles, corner));
      pieces.on_cut.push_back(on_cut[static_cast<size_t>(vertices.back())]);
    }
    pieces.mesh.triangles(corner / 3, corner % 3) = number;
  }
  pieces.mesh.positions = positions(vertices, Eigen::all);
  return pieces;
}

}  // namespace

Pieces cut_at_creases(const Positions& positions, const Triangles& triangles, double crease_angle) {
  const Edges edges = edges_of(triangles);
  const Positions normals = certain_normals(positions, triangles);
  auto smooth = [&](int t, int other) {
    return !normals.row(t).isZero(0) && !normals.row(other).isZero(0) &&
           dihedral_angle(normals.row(t), normals.row(other)) >= crease_angle - kAngleRounding;
  };

  Corners corners(triangles.rows());
  std::vector<bool> on_cut(static_cast<size_t>(positions.rows()), false);
  for (int e = 0; e < edges.triangles.size(); ++e) {
    const auto beside = edges.triangles[e];
    if (beside.size() == 1) continue;
    const Side side = side_of(edges, beside[0], e), other = side_of(edges, beside[1], e);
    const bool same_winding = vertex_of(triangles, side.from) == vertex_of(triangles, other.to);
    if (beside.size() == 2 && same_winding && smooth(beside[0], beside[1])) {
      corners.join(side.from, other.to);
      corners.join(side.to, other.from);
    } else {
      for (int end : {0, 1}) on_cut[static_cast<size_t>(edges.vertices(e, end))] = true;
    }
  }
  return assemble(positions, triangles, corners, on_cut);
}

}  // namespace swage
