#include "intrinsic_delaunay.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace swage {
namespace {

using Eigen::Index;

// Of cotangents: a sum that rounding alone brings below 0 is none. Else four vertices on a circle flip for ever.
constexpr double kCotangentRounding = 1e-10;

/// By Kahan's formula, which needles do not upset.
double area_of(std::array<double, 3> l) {
  std::sort(l.begin(), l.end());
  const auto [c, b, a] = l;
  return std::sqrt(std::max(0.0, (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c)))) / 4;
}

/// Side 3 t + k of triangle t runs from its corner k to corner k + 1.
class Flips {
 public:
  Flips(const Mesh& mesh, const Edges& edges, const std::vector<char>& is_flat)
      : triangles_(mesh.triangles), lengths_(mesh.triangles.rows(), 3) {
    for (Index t = 0; t < triangles_.rows(); ++t) {
      for (int k = 0; k < 3; ++k) {
        lengths_(t, k) = (mesh.positions.row(triangles_(t, (k + 1) % 3)) - mesh.positions.row(triangles_(t, k))).norm();
      }
    }
    join(edges, is_flat);
  }

  IntrinsicTriangles flipped() {
    std::vector<int> asked(twins_.size());
    for (size_t i = 0; i < asked.size(); ++i) asked[i] = static_cast<int>(i);
    while (!asked.empty()) {
      const int side = asked.back();
      asked.pop_back();
      if (!is_to_flip(side)) continue;
      for (const int changed : flip(side)) asked.push_back(changed);
    }
    return {std::move(triangles_), std::move(lengths_)};
  }

 private:
  static int next(int side) { return side % 3 == 2 ? side - 2 : side + 1; }
  int& twin(int side) { return twins_[static_cast<size_t>(side)]; }
  int from(int side) const { return triangles_(side / 3, side % 3); }
  double length(int side) const { return lengths_(side / 3, side % 3); }

  void join(const Edges& edges, const std::vector<char>& is_flat) {
    twins_.assign(static_cast<size_t>(3 * triangles_.rows()), -1);
    const auto side_of = [&](int t, int edge) {
      int k = 0;
      while (edges.triangle_edges(t, k) != edge) ++k;
      return 3 * t + k;
    };
    for (int e = 0; e < edges.triangles.size(); ++e) {
      const Lists::Range beside = edges.triangles[e];
      if (beside.size() != 2 || is_flat[static_cast<size_t>(beside[0])] != 0 ||
          is_flat[static_cast<size_t>(beside[1])] != 0) {
        continue;
      }
      const int one = side_of(beside[0], e), other = side_of(beside[1], e);
      if (from(one) == from(other)) continue;
      twin(one) = other;
      twin(other) = one;
    }
  }

  /// Of the angle that faces the side.
  double cotangent(int side) const {
    const double l = length(side), p = length(next(side)), q = length(next(next(side)));
    return (p * p + q * q - l * l) / (4 * area_of({l, p, q}));
  }

  bool is_to_flip(int side) {
    const int other = twin(side);
    if (other < 0 || other / 3 == side / 3) return false;
    const double a = cotangent(side), b = cotangent(other);
    return a + b < -kCotangentRounding * (1 + std::abs(a) + std::abs(b));
  }

  /// Where the third corner of a side's triangle lies, the side laid along the x axis from 0.
  Eigen::Vector2d corner(int side) const {
    const double l = length(side), p = length(next(side)), q = length(next(next(side)));
    return {(l * l + q * q - p * p) / (2 * l), 2 * area_of({l, p, q}) / l};
  }

  /// From triangles a b c and b a d to a d c and b c d. Gives the four sides around.
  std::array<int, 4> flip(int side) {
    const int other = twin(side), t = side / 3, u = other / 3;
    const int bc = next(side), ca = next(bc), ad = next(other), db = next(ad);
    const int a = from(side), b = from(other), c = from(ca), d = from(db);
    const Eigen::Vector2d at_c = corner(side), at_d = corner(other);
    // The other triangle's side runs from b to a, and its corner lies below.
    const double diagonal = std::hypot(at_c[0] - (length(side) - at_d[0]), at_c[1] + at_d[1]);

    const std::array<int, 4> old = {ad, ca, bc, db}, now = {3 * t, 3 * t + 2, 3 * u, 3 * u + 2};
    std::array<int, 4> twins{};
    std::array<double, 4> lengths{};
    for (size_t i = 0; i < 4; ++i) {
      lengths[i] = length(old[i]);
      const auto among = std::find(old.begin(), old.end(), twin(old[i])) - old.begin();
      twins[i] = among == 4 ? twin(old[i]) : now[static_cast<size_t>(among)];
    }
    triangles_.row(t) << a, d, c;
    triangles_.row(u) << b, c, d;
    for (size_t i = 0; i < 4; ++i) {
      lengths_(now[i] / 3, now[i] % 3) = lengths[i];
      twin(now[i]) = twins[i];
      if (twins[i] >= 0) twin(twins[i]) = now[i];
    }
    lengths_(t, 1) = lengths_(u, 1) = diagonal;
    twin(3 * t + 1) = 3 * u + 1;
    twin(3 * u + 1) = 3 * t + 1;
    return now;
  }

  Triangles triangles_;
  Positions lengths_;
  std::vector<int> twins_;  // Of each side the same one from the other triangle; -1 where it does not flip.
};

}  // namespace

IntrinsicTriangles intrinsic_delaunay(const Mesh& mesh, const Edges& edges, const std::vector<char>& is_flat) {
  return Flips(mesh, edges, is_flat).flipped();
}

Positions half_cotangents(const Positions& lengths, const std::vector<char>& is_flat) {
  Positions result = Positions::Constant(lengths.rows(), 3, 0.5 / std::sqrt(3.0));
  for (Index t = 0; t < lengths.rows(); ++t) {
    if (is_flat[static_cast<size_t>(t)] != 0) continue;
    const Eigen::RowVector3d l = lengths.row(t), squares = l.cwiseAbs2();
    const double area = area_of({l[0], l[1], l[2]});
    for (int k = 0; k < 3; ++k) result(t, k) = (squares.sum() - 2 * squares[k]) / (8 * area);
  }
  return result;
}

}  // namespace swage
