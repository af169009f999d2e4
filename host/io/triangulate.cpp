#include "triangulate.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace swage {
namespace {

using Point = Eigen::Vector2d;

// Twice the signed area.
double area(const Point& a, const Point& b, const Point& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

bool covers(const Point& a, const Point& b, const Point& c, const Point& p) {
  if (p == a || p == b || p == c) return false;
  return area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0;
}

// Seen along the axis nearest to the normal, so that the polygon turns counter-clockwise.
std::vector<Point> flattened(const std::vector<int>& polygon, const Positions& positions,
                             const Eigen::Vector3d& normal) {
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  int right = (axis + 1) % 3, up = (axis + 2) % 3;
  if (normal[axis] < 0) std::swap(right, up);
  std::vector<Point> points;
  points.reserve(polygon.size());
  const Eigen::RowVector3d origin = positions.row(polygon[0]);
  for (const int v : polygon) {
    points.emplace_back(positions(v, right) - origin[right], positions(v, up) - origin[up]);
  }
  return points;
}

// Each triangle of the fan has an area that rounding cannot explain.
bool fan_is_right(const std::vector<Point>& points) {
  double extent = 0;
  for (const Point& p : points) extent = std::max(extent, p.squaredNorm());
  for (size_t k = 1; k + 1 < points.size(); ++k) {
    if (area(points[0], points[k], points[k + 1]) <= 1e-12 * extent) return false;
  }
  return true;
}

// A ring of the corners that are left, in their order.
class Ears {
 public:
  explicit Ears(std::vector<Point> points)
      : points_(std::move(points)), next_(points_.size()), back_(points_.size()), within_(points_.size(), kNone) {
    for (size_t k = 0; k < points_.size(); ++k) {
      next_[k] = (k + 1) % points_.size();
      back_[next_[k]] = k;
    }
  }

  // Calls found(a, b, c) for each triangle.
  template <typename Found>
  void cut(Found&& found) {
    size_t k = 1, tried = 0;
    bool crosses_itself = false;
    for (size_t left = points_.size(); left > 2;) {
      if (crosses_itself ? is_convex(k) || tried >= left : is_ear(k)) {
        found(back_[k], k, next_[k]);
        next_[back_[k]] = next_[k];
        back_[next_[k]] = back_[k];
        within_[back_[k]] = within_[next_[k]] = kNone;
        within_[k] = kCut;
        --left;
        tried = 0;
      } else if (++tried == left && !crosses_itself) {
        // A simple polygon always has an ear. Here any convex corner will do, and at last any corner.
        crosses_itself = true;
        tried = 0;
      }
      k = next_[k];
    }
  }

 private:
  bool is_convex(size_t k) const { return area(points_[back_[k]], points_[k], points_[next_[k]]) > 0; }

  bool is_ear(size_t k) {
    if (!is_convex(k)) return false;
    // Asked again and again, of a long spiral once a corner that is cut.
    if (within_[k] != kNone && within_[within_[k]] != kCut) return false;
    const Point &a = points_[back_[k]], &b = points_[k], &c = points_[next_[k]];
    for (size_t other = next_[next_[k]]; other != back_[k]; other = next_[other]) {
      if (!covers(a, b, c, points_[other])) continue;
      within_[k] = other;
      return false;
    }
    return true;
  }

  static constexpr size_t kNone = static_cast<size_t>(-1), kCut = static_cast<size_t>(-2);

  std::vector<Point> points_;
  std::vector<size_t> next_, back_;
  std::vector<size_t> within_;  // A corner known to be in the triangle of this one and those beside it.
};

void append_fan(const std::vector<int>& polygon, std::vector<int>& triangles) {
  for (size_t k = 1; k + 1 < polygon.size(); ++k) {
    triangles.insert(triangles.end(), {polygon[0], polygon[k], polygon[k + 1]});
  }
}

}  // namespace

Eigen::Vector3d area_vector(const std::vector<int>& polygon, const PositionsRef& positions) {
  const Eigen::Vector3d origin = positions.row(polygon[0]);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Vector3d side = positions.row(polygon[1]).transpose() - origin;
  for (size_t k = 2; k < polygon.size(); ++k) {
    const Eigen::Vector3d next = positions.row(polygon[k]).transpose() - origin;
    sum += side.cross(next);
    side = next;
  }
  return sum;
}

bool triangulate(const std::vector<int>& polygon, const Positions& positions, size_t longest,
                 std::vector<int>& triangles) {
  const bool is_triangle = polygon.size() == 3;
  const Eigen::Vector3d normal = is_triangle ? Eigen::Vector3d::Zero() : area_vector(polygon, positions);
  if (is_triangle || normal.isZero(0)) {
    append_fan(polygon, triangles);
    return true;
  }
  std::vector<Point> points = flattened(polygon, positions, normal);
  if (fan_is_right(points)) {
    append_fan(polygon, triangles);
    return true;
  }
  if (polygon.size() > longest) return false;
  Ears(std::move(points)).cut([&](size_t a, size_t b, size_t c) {
    triangles.insert(triangles.end(), {polygon[a], polygon[b], polygon[c]});
  });
  return true;
}

}  // namespace swage
