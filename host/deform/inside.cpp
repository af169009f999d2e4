#include "inside.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "adjacency.h"
#include "nearest.h"
#include "swage/thrown.h"

namespace swage {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Models have sides along the axes, in whose directions rays would graze them.
Positions askew(const Positions& positions) {
  const Eigen::Quaterniond turn(0.83, 0.31, -0.23, 0.41);
  return positions * turn.normalized().toRotationMatrix().transpose();
}

double side(const Vector2d& a, const Vector2d& b, const Vector2d& p) {
  return (b - a).x() * (p - a).y() - (b - a).y() * (p - a).x();
}

/// Counts where lines along the axes cross a surface.
class Crossings {
 public:
  Crossings(const Positions& positions, const Triangles& triangles)
      : positions_(positions),
        triangles_(triangles),
        component_(components(triangles, static_cast<int>(positions.rows()))),
        tree_(positions_, triangles_),
        low_(positions.colwise().minCoeff()),
        high_(positions.colwise().maxCoeff()) {}

  bool encloses(const Vector3d& point) const {
    std::map<int, int> lines;  // Of each component.
    for (int axis = 0; axis < 3; ++axis) {
      for (const auto& [component, odd] : odd_crossings(point, axis)) {
        if (odd.below && odd.above && ++lines[component] == 2) return true;
      }
    }
    return false;
  }

 private:
  struct Odd {
    bool below = false, above = false;
  };

  std::map<int, Odd> odd_crossings(const Vector3d& point, int axis) const {
    std::map<int, Odd> odd;
    Vector3d low = point, high = point;
    low[axis] = low_[axis];
    high[axis] = high_[axis];
    tree_.near({low, high}, [&](int t) {
      const std::optional<double> height = crossing(point, axis, t);
      if (!height) return;
      Odd& component = odd[component_[static_cast<size_t>(triangles_(t, 0))]];
      bool& side = *height > point[axis] ? component.above : component.below;
      side = !side;
    });
    return odd;
  }

  std::optional<double> crossing(const Vector3d& point, int axis, int triangle) const {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    std::array<Vector2d, 3> corners;
    Vector3d heights;
    for (int k = 0; k < 3; ++k) {
      const auto corner = positions_.row(triangles_(triangle, k));
      corners[static_cast<size_t>(k)] = {corner[u], corner[v]};
      heights[k] = corner[axis];
    }
    const Vector2d p(point[u], point[v]);
    const Vector3d parts(side(corners[1], corners[2], p), side(corners[2], corners[0], p),
                         side(corners[0], corners[1], p));
    if (!(parts.minCoeff() >= 0 || parts.maxCoeff() <= 0) || parts.sum() == 0) return std::nullopt;
    return parts.dot(heights) / parts.sum();
  }

  const Positions& positions_;
  const Triangles& triangles_;
  std::vector<int> component_;
  TriangleTree tree_;
  Eigen::RowVector3d low_, high_;
};

}  // namespace

std::vector<char> are_inside(const Mesh& surface, const Positions& vertices, const Tetrahedra& tetrahedra,
                             const Poll& poll) {
  const Positions turned = askew(surface.positions), corners = askew(vertices);
  const Crossings crossings(turned, surface.triangles);
  std::vector<char> inside(static_cast<size_t>(tetrahedra.rows()), 0);
  constexpr Eigen::Index kChunk = 4096;
  for (Eigen::Index first = 0; first < tetrahedra.rows(); first += kChunk) {
    ask(poll);
    const Eigen::Index last = std::min(first + kChunk, tetrahedra.rows());
    Thrown thrown;
#pragma omp parallel for schedule(static)
    for (Eigen::Index t = first; t < last; ++t) {
      thrown.keep([&] {
        const Vector3d middle = corners(tetrahedra.row(t), Eigen::all).colwise().mean();
        inside[static_cast<size_t>(t)] = crossings.encloses(middle) ? 1 : 0;
      });
    }
    thrown.rethrow();
  }
  return inside;
}

}  // namespace swage
