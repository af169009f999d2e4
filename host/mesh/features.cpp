#include "swage/features.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Geometry>

#include "adjacency.h"
#include "angle_rounding.h"
#include "messages.h"
#include "swage/error.h"

namespace swage {
namespace {

// In box diagonals: rounding of coordinates, as in files of single precision, may have made a plane or direction of
// less.
constexpr double kLeastExtent = 1e-6;
// Flat triangles side by side that are looked across.
constexpr int kMostHops = 100;

/// Those whose corners are three vertices.
Triangles proper(const TrianglesRef& triangles) {
  std::vector<Eigen::Index> kept;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const auto corners = triangles.row(t);
    if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0]) kept.push_back(t);
  }
  return triangles(kept, Eigen::all);
}

/// What lies beside the edges of a mesh.
class BesideEdges {
 public:
  BesideEdges(const PositionsRef& positions, const Triangles& triangles)
      : positions_(positions), triangles_(triangles), edges_(edges_of(triangles)) {
    least_ = kLeastExtent * box_diagonal(positions);
    for (Eigen::Index e = 0; e < edges_.vertices.rows(); ++e) {
      lengths_.push_back((positions.row(edges_.vertices(e, 1)) - positions.row(edges_.vertices(e, 0))).norm());
    }
    for (int t = 0; t < triangles.rows(); ++t) is_flat_.push_back(height(t) <= least_);
  }

  const Edges& edges() const { return edges_; }

  bool is_feature(int edge, double feature_angle) const {
    if (length(edge) <= least_) return false;
    const std::vector<int> sheets = apexes(edge);
    if (sheets.size() != 2) return !sheets.empty();
    return angle_between(edge, sheets[0], sheets[1]) < feature_angle - kAngleRounding;
  }

 private:
  double length(int edge) const { return lengths_[static_cast<size_t>(edge)]; }

  double height(int triangle) const {
    const Eigen::RowVector3d a = positions_.row(triangles_(triangle, 0));
    const Eigen::RowVector3d ab = positions_.row(triangles_(triangle, 1)) - a;
    const Eigen::RowVector3d ac = positions_.row(triangles_(triangle, 2)) - a;
    double longest = 0;
    for (int k = 0; k < 3; ++k) longest = std::max(longest, length(edges_.triangle_edges(triangle, k)));
    return longest > 0 ? ab.cross(ac).norm() / longest : 0;
  }

  int longest_other(int triangle, int edge) const {
    int found = -1;
    for (int k = 0; k < 3; ++k) {
      const int other = edges_.triangle_edges(triangle, k);
      if (other != edge && (found < 0 || length(other) > length(found))) found = other;
    }
    return found;
  }

  int opposite(int triangle, int edge) const {
    int k = 0;
    while (edges_.triangle_edges(triangle, k) != edge) ++k;
    return triangles_(triangle, (k + 2) % 3);
  }

  /// The vertex opposite the edge, across flat triangles; -1 where the surface ends or parts there.
  int apex(int edge, int triangle) const {
    for (int hops = 0; is_flat_[static_cast<size_t>(triangle)]; ++hops) {
      edge = longest_other(triangle, edge);
      const Lists::Range beside = edges_.triangles[edge];
      if (beside.size() != 2 || hops == kMostHops) return -1;
      triangle = beside[0] == triangle ? beside[1] : beside[0];
    }
    return opposite(triangle, edge);
  }

  /// One a sheet that meets the edge.
  std::vector<int> apexes(int edge) const {
    std::vector<int> found;
    for (int triangle : edges_.triangles[edge]) {
      const int vertex = apex(edge, triangle);
      if (vertex >= 0) found.push_back(vertex);
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

  /// Between the half-planes from the edge through two vertices.
  double angle_between(int edge, int a, int b) const {
    const Eigen::RowVector3d from = positions_.row(edges_.vertices(edge, 0));
    const Eigen::RowVector3d along = (positions_.row(edges_.vertices(edge, 1)) - from) / length(edge);
    const auto away = [&](int vertex) -> Eigen::RowVector3d {
      const Eigen::RowVector3d spoke = positions_.row(vertex) - from;
      return spoke - spoke.dot(along) * along;
    };
    const Eigen::RowVector3d u = away(a), v = away(b);
    return std::atan2(u.cross(v).norm(), u.dot(v));
  }

  const PositionsRef& positions_;
  const Triangles& triangles_;
  Edges edges_;
  double least_ = 0;
  std::vector<double> lengths_;
  std::vector<char> is_flat_;
};

}  // namespace

FeatureEdges feature_edges(const PositionsRef& positions, const TrianglesRef& triangles, double feature_angle) {
  check(positions, triangles);
  if (!(feature_angle >= 0 && feature_angle <= std::numbers::pi)) {
    throw InvalidInput("feature_edges: feature_angle: " + digits(feature_angle) +
                       " is not an angle between 0 and pi radians");
  }
  const Triangles kept = proper(triangles);
  const BesideEdges beside(positions, kept);
  const Eigen::Index count = beside.edges().vertices.rows();
  std::vector<char> is_feature(static_cast<size_t>(count));
#pragma omp parallel for schedule(static)
  for (Eigen::Index e = 0; e < count; ++e) {
    is_feature[static_cast<size_t>(e)] = beside.is_feature(static_cast<int>(e), feature_angle);
  }
  std::vector<Eigen::Index> features;
  for (Eigen::Index e = 0; e < count; ++e) {
    if (is_feature[static_cast<size_t>(e)]) features.push_back(e);
  }
  return beside.edges().vertices(features, Eigen::all);
}

}  // namespace swage
