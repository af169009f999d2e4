// Shapes to take styles from, by formula.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "messages.h"
#include "swage/error.h"
#include "swage/style.h"

namespace swage {
namespace {

using Eigen::RowVector3d;
using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

const double kGolden = std::numbers::phi;

Points signs(double x, double y, double z) {
  Points points;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-1.0, 1.0}) {
      for (const double c : {-1.0, 1.0}) {
        const Vector3d point(a * x, b * y, c * z);
        if (std::find(points.begin(), points.end(), point) == points.end()) points.push_back(point);
      }
    }
  }
  return points;
}

/// With x, y and z going round.
Points cyclic(const Points& points) {
  Points result;
  for (const Vector3d& p : points) {
    for (const Vector3d& q : {Vector3d(p[0], p[1], p[2]), Vector3d(p[1], p[2], p[0]), Vector3d(p[2], p[0], p[1])}) {
      if (std::find(result.begin(), result.end(), q) == result.end()) result.push_back(q);
    }
  }
  return result;
}

Points both(Points a, const Points& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Points opposite(Points points) {
  for (Vector3d& p : points) p = -p;
  return points;
}

/// Of a convex shape the vertices that are farthest along a normal, counter-clockwise about it.
std::vector<int> face_of(const Points& vertices, const Vector3d& normal) {
  double farthest = 0;
  for (const Vector3d& v : vertices) farthest = std::max(farthest, v.dot(normal));
  std::vector<int> face;
  for (int i = 0; i < static_cast<int>(vertices.size()); ++i) {
    if (vertices[static_cast<size_t>(i)].dot(normal) > farthest * (1 - 1e-9)) face.push_back(i);
  }
  const Vector3d x = normal.unitOrthogonal(), y = normal.normalized().cross(x);
  const auto angle = [&](int i) {
    const Vector3d& v = vertices[static_cast<size_t>(i)];
    return std::atan2(v.dot(y), v.dot(x));
  };
  std::sort(face.begin(), face.end(), [&](int i, int j) { return angle(i) < angle(j); });
  return face;
}

/// About the origin, from its vertices and the normals of its faces.
Mesh convex(const Points& vertices, const Points& normals) {
  std::vector<std::array<int, 3>> triangles;
  for (const Vector3d& normal : normals) {
    const std::vector<int> face = face_of(vertices, normal);
    for (size_t k = 2; k < face.size(); ++k) triangles.push_back({face[0], face[k - 1], face[k]});
  }
  Mesh mesh{Positions(static_cast<Eigen::Index>(vertices.size()), 3),
            Triangles(static_cast<Eigen::Index>(triangles.size()), 3)};
  for (size_t i = 0; i < vertices.size(); ++i) mesh.positions.row(static_cast<Eigen::Index>(i)) = vertices[i];
  for (size_t t = 0; t < triangles.size(); ++t) {
    mesh.triangles.row(static_cast<Eigen::Index>(t)) << triangles[t][0], triangles[t][1], triangles[t][2];
  }
  return mesh;
}

Points tetrahedral() { return {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}; }
Points octahedral() { return cyclic(signs(1, 0, 0)); }
Points cubic() { return signs(1, 1, 1); }
Points icosahedral() { return cyclic(signs(0, 1, kGolden)); }
Points dodecahedral() { return both(cubic(), cyclic(signs(0, kGolden, 1 / kGolden))); }

Vector3d on_circle(int k, int sides, double z) {
  const double angle = 2 * std::numbers::pi * k / sides;
  return {std::cos(angle), std::sin(angle), z};
}

void check_sides(const char* function, int sides) {
  if (sides < 3) throw InvalidInput(std::string(function) + ": sides: " + std::to_string(sides) + " is below 3");
}

/// The nearest point of the cube [-inner, inner]³, and `radius` from there on.
RowVector3d rounded(const RowVector3d& point, double radius) {
  const double inner = 1 - radius;
  const RowVector3d core = point.cwiseMax(-inner).cwiseMin(inner);
  return core + radius * (point - core).normalized();
}

}  // namespace

Mesh style_shape(StyleShape shape) {
  // A shape's faces look to where its dual's vertices are.
  const auto made = [&] {
    switch (shape) {
      case StyleShape::tetrahedron:
        return convex(tetrahedral(), opposite(tetrahedral()));
      case StyleShape::octahedron:
        return convex(octahedral(), cubic());
      case StyleShape::dodecahedron:
        return convex(dodecahedral(), icosahedral());
      case StyleShape::icosahedron:
        return convex(icosahedral(), dodecahedral());
      case StyleShape::cube:
        break;
    }
    return convex(cubic(), octahedral());
  };
  Mesh mesh = made();
  mesh.positions /= mesh.positions.row(0).norm();
  return mesh;
}

Mesh prism(int sides) {
  check_sides("prism", sides);
  Points vertices, normals = {{0, 0, 1}, {0, 0, -1}};
  for (int k = 0; k < sides; ++k) {
    vertices.push_back(on_circle(2 * k, 2 * sides, 0.5));
    vertices.push_back(on_circle(2 * k, 2 * sides, -0.5));
    normals.push_back(on_circle(2 * k + 1, 2 * sides, 0));
  }
  return convex(vertices, normals);
}

Mesh bipyramid(int sides) {
  check_sides("bipyramid", sides);
  Points vertices = {{0, 0, 1}, {0, 0, -1}}, normals;
  const double slope = std::cos(std::numbers::pi / sides);  // Of the middles of sides from the axis.
  for (int k = 0; k < sides; ++k) {
    vertices.push_back(on_circle(2 * k, 2 * sides, 0));
    normals.push_back(on_circle(2 * k + 1, 2 * sides, slope));
    normals.push_back(on_circle(2 * k + 1, 2 * sides, -slope));
  }
  return convex(vertices, normals);
}

Mesh rounded_cube(double radius, int cells) {
  if (!(radius > 0 && radius <= 1)) throw InvalidInput("rounded_cube: radius: " + digits(radius) + " is not in (0, 1]");
  if (cells < 2) throw InvalidInput("rounded_cube: cells: " + std::to_string(cells) + " is below 2");
  std::map<std::array<int, 3>, int> numbers;
  std::vector<std::array<int, 3>> triangles;
  const auto vertex = [&](int axis, int side, int a, int b) {
    std::array<int, 3> at{};
    at[static_cast<size_t>(axis)] = side * cells;
    at[static_cast<size_t>((axis + 1) % 3)] = side == 1 ? a : b;
    at[static_cast<size_t>((axis + 2) % 3)] = side == 1 ? b : a;
    return numbers.emplace(at, static_cast<int>(numbers.size())).first->second;
  };
  for (int face = 0; face < 6; ++face) {
    for (int a = 0; a < cells; ++a) {
      for (int b = 0; b < cells; ++b) {
        const auto corner = [&](int i, int j) { return vertex(face % 3, face / 3, a + i, b + j); };
        triangles.push_back({corner(0, 0), corner(1, 0), corner(1, 1)});
        triangles.push_back({corner(0, 0), corner(1, 1), corner(0, 1)});
      }
    }
  }
  Mesh mesh{Positions(static_cast<Eigen::Index>(numbers.size()), 3),
            Triangles(static_cast<Eigen::Index>(triangles.size()), 3)};
  for (const auto& [at, number] : numbers) {
    const RowVector3d grid(at[0], at[1], at[2]);
    mesh.positions.row(number) = rounded((2 * grid / cells).array() - 1, radius);
  }
  for (size_t t = 0; t < triangles.size(); ++t) {
    mesh.triangles.row(static_cast<Eigen::Index>(t)) << triangles[t][0], triangles[t][1], triangles[t][2];
  }
  return mesh;
}

}  // namespace swage
