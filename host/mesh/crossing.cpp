#include "crossing.h"

#include <algorithm>

#include "orient.h"

namespace swage {
namespace {

using Point = Eigen::Vector3d;
using Signs = std::array<int, 3>;

Eigen::Vector2d without(int axis, const Point& point) { return {point[(axis + 1) % 3], point[(axis + 2) % 3]}; }

/// Which way round the three run, seen along an axis.
int turn(int axis, const Point& a, const Point& b, const Point& c) {
  return orient2d(without(axis, a), without(axis, b), without(axis, c));
}

/// An axis along which the triangle is not seen edge-on; 3 where it is so along all.
int open_axis(const Corners& t) {
  int axis = 0;
  while (axis < 3 && turn(axis, t.points[0], t.points[1], t.points[2]) == 0) ++axis;
  return axis;
}

/// On which side of the triangle's plane the points lie.
Signs sides(const Corners& plane, const Corners& of) {
  const auto side = [&t = plane.points](const Point& point) { return orient3d(t[0], t[1], t[2], point); };
  return {side(of.points[0]), side(of.points[1]), side(of.points[2])};
}

/// The three signs have both 1 and -1 among them.
bool differ(const Signs& signs) {
  const auto [low, high] = std::minmax_element(signs.begin(), signs.end());
  return *low < 0 && *high > 0;
}

bool all_are(int sign, const Signs& signs) {
  return std::all_of(signs.begin(), signs.end(), [&](int s) { return s == sign; });
}

/// Of a segment in the triangle's plane. They are apart where the line along a side of the triangle has all of the
/// segment strictly beyond it, or the line along the segment all of the triangle strictly on one side.
bool meets_in_plane(const Point& p, const Point& q, const Corners& t) {
  const int axis = open_axis(t);
  const auto seen = [&](const Point& a, const Point& b, const Point& c) { return turn(axis, a, b, c); };
  const auto& [a, b, c] = t.points;
  const int inside = seen(a, b, c);
  for (size_t k = 0; k < 3; ++k) {
    const Point &from = t.points[k], &to = t.points[(k + 1) % 3];
    if (seen(from, to, p) == -inside && seen(from, to, q) == -inside) return false;
  }
  const Signs around{seen(p, q, a), seen(p, q, b), seen(p, q, c)};
  return !all_are(1, around) && !all_are(-1, around);
}

/// Of a segment whose ends lie on these sides of the triangle's plane.
bool meets(const Point& p, int p_side, const Point& q, int q_side, const Corners& t) {
  if (p_side * q_side > 0) return false;
  if (p_side == 0 && q_side == 0) return meets_in_plane(p, q, t);
  const auto& [a, b, c] = t.points;
  return !differ({orient3d(p, q, a, b), orient3d(p, q, b, c), orient3d(p, q, c, a)});
}

/// Whether a side of the triangle, shared vertices first, meets another one. Of one with a shared vertex it is enough
/// to ask the side across: what the triangles have in common reaches from that vertex to such a side of one of them.
bool a_side_meets(const Corners& of, const Signs& sides, int shared, const Corners& other) {
  const size_t count = shared == 1 ? 1 : 3;
  for (size_t k = 0; k < count; ++k) {
    const size_t i = (k + 1) % 3, j = (k + 2) % 3;
    if (meets(of.points[i], sides[i], of.points[j], sides[j], other)) return true;
  }
  return false;
}

/// Whether the triangles at an edge, their first two corners, lie on each other.
bool are_folded(const Corners& t, const Point& d) {
  const auto& [a, b, c] = t.points;
  if (orient3d(a, b, c, d) != 0) return false;
  const int axis = open_axis(t);
  return turn(axis, a, b, c) == turn(axis, a, b, d);
}

/// All corners that may lie in the other's plane without being shared are strictly on one side of it.
bool is_beside(const Signs& sides, int shared) {
  return std::all_of(sides.begin() + shared, sides.end(), [&](int side) { return side != 0 && side == sides.back(); });
}

Corners with_shared_first(const Corners& t, const Corners& other) {
  Corners result;
  size_t first = 0, last = 2;
  for (size_t k = 0; k < 3; ++k) {
    const bool shared = std::count(other.vertices.begin(), other.vertices.end(), t.vertices[k]) > 0;
    const size_t at = shared ? first++ : last--;
    result.points[at] = t.points[k];
    result.vertices[at] = t.vertices[k];
  }
  return result;
}

int count_shared(const Corners& a, const Corners& b) {
  return static_cast<int>(std::count_if(a.vertices.begin(), a.vertices.end(), [&](int v) {
    return std::count(b.vertices.begin(), b.vertices.end(), v) > 0;
  }));
}

}  // namespace

bool spans_a_plane(const Corners& triangle) { return open_axis(triangle) < 3; }

bool cross(const Corners& a, const Corners& b) {
  const int shared = count_shared(a, b);
  if (shared == 3) return true;
  const Corners first = with_shared_first(a, b), second = with_shared_first(b, a);
  if (shared == 2) return are_folded(first, second.points[2]);
  const Signs of_second = sides(first, second);
  if (is_beside(of_second, shared)) return false;
  const Signs of_first = sides(second, first);
  if (is_beside(of_first, shared)) return false;
  return a_side_meets(first, of_first, shared, second) || a_side_meets(second, of_second, shared, first);
}

}  // namespace swage
