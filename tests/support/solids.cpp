#include "solids.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "shapes.h"

namespace swage::test {
namespace {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

struct Faces {
  Path points;
  std::vector<Eigen::Vector3i> triangles;

  int add(const Vector3d& point) {
    points.push_back(point);
    return static_cast<int>(points.size()) - 1;
  }
  void quad(int a, int b, int c, int d) {
    triangles.emplace_back(a, b, c);
    triangles.emplace_back(a, c, d);
  }
  /// Between two closed rings of vertices that begin at a and b.
  void band(int a, int b, int count) {
    for (int i = 0; i < count; ++i) quad(a + i, a + (i + 1) % count, b + (i + 1) % count, b + i);
  }
  void fan(int middle, int ring, int count) {
    for (int i = 0; i < count; ++i) triangles.emplace_back(middle, ring + (i + 1) % count, ring + i);
  }
  /// Wound so that it encloses a positive volume.
  Mesh mesh() const {
    Mesh result{Positions(points.size(), 3), Triangles(triangles.size(), 3)};
    for (size_t i = 0; i < points.size(); ++i) result.positions.row(static_cast<Index>(i)) = points[i];
    for (size_t i = 0; i < triangles.size(); ++i) result.triangles.row(static_cast<Index>(i)) = triangles[i];
    if (volume(result) < 0) result.triangles.col(1).swap(result.triangles.col(2));
    return result;
  }
};

double cross(const Vector2d& a, const Vector2d& b) { return a[0] * b[1] - a[1] * b[0]; }

/// Ears of a counter-clockwise outline, cut off one after the other.
std::vector<Eigen::Vector3i> triangles_of(const Outline& outline) {
  std::vector<int> left(outline.size());
  for (size_t i = 0; i < left.size(); ++i) left[i] = static_cast<int>(i);
  const auto at = [&](int i) -> const Vector2d& { return outline[static_cast<size_t>(i)]; };
  const auto is_ear = [&](int a, int b, int c) {
    if (cross(at(b) - at(a), at(c) - at(b)) <= 0) return false;
    return std::none_of(left.begin(), left.end(), [&](int i) {
      return i != a && i != b && i != c && cross(at(b) - at(a), at(i) - at(a)) >= 0 &&
             cross(at(c) - at(b), at(i) - at(b)) >= 0 && cross(at(a) - at(c), at(i) - at(c)) >= 0;
    });
  };
  std::vector<Eigen::Vector3i> triangles;
  size_t tried = 0;
  for (size_t i = 0; left.size() > 3 && tried <= left.size();) {
    const size_t count = left.size();
    const int a = left[(i + count - 1) % count], b = left[i % count], c = left[(i + 1) % count];
    if (is_ear(a, b, c)) {
      triangles.emplace_back(a, b, c);
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(i % count));
      i = i % count + 1;  // The next ear is not beside this one: triangles stay rounder.
      tried = 0;
    } else {
      ++i;
      ++tried;
    }
  }
  triangles.emplace_back(left[0], left[1], left[2]);
  return triangles;
}

}  // namespace

Outline arc(const Vector2d& centre, const Vector2d& radii, double from, double to, int steps) {
  Outline points;
  for (int i = 0; i <= steps; ++i) {
    const double angle = from + (to - from) * i / steps;
    points.emplace_back(centre + radii.cwiseProduct(Vector2d(std::cos(angle), std::sin(angle))));
  }
  return points;
}

Outline rounded_rectangle(const Vector2d& size, double radius, int steps) {
  Outline points;
  for (int corner = 0; corner < 4; ++corner) {
    const double from = corner * pi / 2;
    const Vector2d side(corner == 0 || corner == 3 ? 1 : -1, corner < 2 ? 1 : -1);
    const Vector2d centre = side.cwiseProduct(size / 2 - Vector2d::Constant(radius));
    const Outline bend = arc(centre, {radius, radius}, from, from + pi / 2, steps);
    points.insert(points.end(), bend.begin(), bend.end());
  }
  return points;
}

Outline cut(const Outline& outline, int steps) {
  Outline points = {outline.front()};
  for (size_t i = 1; i < outline.size(); ++i) {
    for (int k = 1; k <= steps; ++k) {
      points.emplace_back(k == steps ? outline[i] : outline[i - 1] + (outline[i] - outline[i - 1]) * k / steps);
    }
  }
  return points;
}

Mesh turned(const Outline& profile, int around) {
  Faces faces;
  const bool closed = profile.front()[0] > 0;
  std::vector<int> rings;
  for (const Vector2d& point : profile) {
    rings.push_back(static_cast<int>(faces.points.size()));
    for (int i = 0; i < (point[0] > 0 ? around : 1); ++i) {
      const double angle = 2 * pi * i / around;
      faces.add({point[0] * std::cos(angle), point[1], -point[0] * std::sin(angle)});
    }
  }
  const size_t count = rings.size();
  for (size_t i = 0; i + 1 < count; ++i) {
    if (profile[i][0] == 0) {
      faces.fan(rings[i], rings[i + 1], around);
    } else if (profile[i + 1][0] > 0) {
      faces.band(rings[i], rings[i + 1], around);
    } else {
      faces.fan(rings[i + 1], rings[i], around);
      for (size_t t = faces.triangles.size() - static_cast<size_t>(around); t < faces.triangles.size(); ++t) {
        std::swap(faces.triangles[t][1], faces.triangles[t][2]);
      }
    }
  }
  if (closed) faces.band(rings.back(), rings.front(), around);
  return faces.mesh();
}

Mesh loft(const std::vector<Path>& rings) {
  Faces faces;
  const int around = static_cast<int>(rings.front().size()), last = static_cast<int>(rings.size() - 1) * around;
  for (const Path& points : rings) faces.points.insert(faces.points.end(), points.begin(), points.end());
  for (int i = 0; i < last; i += around) faces.band(i, i + around, around);
  const auto middle = [&](const Path& points) {
    Vector3d sum = Vector3d::Zero();
    for (const Vector3d& point : points) sum += point;
    return faces.add(sum / around);
  };
  const int low = middle(rings.front()), high = middle(rings.back());
  faces.fan(low, 0, around);
  faces.fan(high, last, around);
  for (size_t t = faces.triangles.size() - static_cast<size_t>(around); t < faces.triangles.size(); ++t) {
    std::swap(faces.triangles[t][1], faces.triangles[t][2]);
  }
  return faces.mesh();
}

Mesh rod(const Path& path, double radius, int around, bool closed) {
  const size_t count = path.size();
  const auto direction = [&](size_t i) {
    const size_t before = i > 0 ? i - 1 : closed ? count - 1 : 0, after = i + 1 < count ? i + 1 : closed ? 0 : i;
    return Vector3d((path[after] - path[before]).normalized());
  };
  std::vector<Path> rings;
  Vector3d along = direction(0), across = along.unitOrthogonal();
  for (size_t i = 0; i < count; ++i) {
    // The frame turns no more than the path does.
    const Vector3d next = direction(i);
    across = Eigen::Quaterniond::FromTwoVectors(along, next) * across;
    along = next;
    Path points;
    for (int k = 0; k < around; ++k) {
      const double angle = 2 * pi * k / around;
      points.emplace_back(path[i] + radius * (std::cos(angle) * across + std::sin(angle) * along.cross(across)));
    }
    rings.push_back(std::move(points));
  }
  if (!closed) return loft(rings);
  Faces faces;
  for (const Path& points : rings) faces.points.insert(faces.points.end(), points.begin(), points.end());
  for (size_t i = 0; i < count; ++i) {
    faces.band(static_cast<int>(i) * around, static_cast<int>((i + 1) % count) * around, around);
  }
  return faces.mesh();
}

Mesh pulled(const Outline& outline, double depth, int steps) {
  Faces faces;
  const int around = static_cast<int>(outline.size());
  for (int k = 0; k <= steps; ++k) {
    for (const Vector2d& point : outline)
      faces.add({point[0], point[1], depth * (static_cast<double>(k) / steps - 0.5)});
  }
  for (int k = 0; k < steps; ++k) faces.band(k * around, (k + 1) * around, around);
  for (const Eigen::Vector3i& t : triangles_of(outline)) {
    faces.triangles.emplace_back(t[0], t[2], t[1]);
    faces.triangles.emplace_back(t.array() + steps * around);
  }
  return faces.mesh();
}

Mesh slab(const Vector3d& size, double bevel) {
  const Vector3d half = size / 2, inner = half.array() - bevel;
  const auto outline = [&](double x, double z) {
    const Outline corners = {{x, z - bevel},  {x, bevel - z},  {x - bevel, -z}, {bevel - x, -z},
                             {-x, bevel - z}, {-x, z - bevel}, {bevel - x, z},  {x - bevel, z}};
    return corners;
  };
  std::vector<Path> rings;
  for (const auto& [y, inset] : {std::pair{-half[1], bevel}, {-inner[1], 0.0}, {inner[1], 0.0}, {half[1], bevel}}) {
    Path points;
    for (const Vector2d& corner : outline(half[0] - inset, half[2] - inset))
      points.emplace_back(corner[0], y, corner[1]);
    rings.push_back(std::move(points));
  }
  return loft(rings);
}

Mesh ball(const Vector3d& radii, int around) {
  const int rings = std::max(around / 2, 3);
  Outline profile = arc({0, 0}, {1, 1}, -pi / 2, pi / 2, rings);
  profile.front() = {0, -1};
  profile.back() = {0, 1};
  Mesh mesh = turned(profile, around);
  mesh.positions *= radii.asDiagonal();
  return mesh;
}

Mesh ring(double radius, double thickness, int around, int across) {
  Outline profile = arc({radius, 0}, {thickness, thickness}, 0, 2 * pi, across);
  profile.pop_back();
  return turned(profile, around);
}

}  // namespace swage::test
