#include "shapes.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

namespace swage::test {
namespace {

struct Builder {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3i> faces;

  int add(const Eigen::Vector3d& point) {
    points.push_back(point);
    return static_cast<int>(points.size()) - 1;
  }
  void quad(int a, int b, int c, int d) {
    faces.emplace_back(a, b, c);
    faces.emplace_back(a, c, d);
  }
  Mesh mesh() const {
    Mesh result{Positions(points.size(), 3), Triangles(faces.size(), 3)};
    for (size_t i = 0; i < points.size(); ++i) result.positions.row(static_cast<Eigen::Index>(i)) = points[i];
    for (size_t i = 0; i < faces.size(); ++i) result.triangles.row(static_cast<Eigen::Index>(i)) = faces[i];
    return result;
  }
};

Builder icosahedron() {
  const double g = (1 + std::sqrt(5.0)) / 2;
  Builder b;
  b.points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
              {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  b.faces = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
             {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
             {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  return b;
}

void subdivide(Builder& b) {
  std::map<std::pair<int, int>, int> middles;
  auto middle = [&](int i, int j) {
    const auto [at, fresh] = middles.try_emplace(std::minmax(i, j), 0);
    if (fresh) at->second = b.add((b.points[static_cast<size_t>(i)] + b.points[static_cast<size_t>(j)]) / 2);
    return at->second;
  };
  std::vector<Eigen::Vector3i> faces;
  for (const Eigen::Vector3i& f : b.faces) {
    const int x = middle(f[0], f[1]), y = middle(f[1], f[2]), z = middle(f[2], f[0]);
    faces.insert(faces.end(), {{f[0], x, z}, {f[1], y, x}, {f[2], z, y}, {x, y, z}});
  }
  b.faces = std::move(faces);
}

}  // namespace

Mesh subdivided(const Mesh& mesh) {
  Builder b;
  for (const auto& point : mesh.positions.rowwise()) b.points.emplace_back(point);
  for (const auto& triangle : mesh.triangles.rowwise()) b.faces.emplace_back(triangle);
  subdivide(b);
  return b.mesh();
}

Mesh sphere(double radius, int subdivisions) {
  Builder b = icosahedron();
  for (int i = 0; i < subdivisions; ++i) subdivide(b);
  for (Eigen::Vector3d& p : b.points) p *= radius / p.norm();
  return b.mesh();
}

Mesh cylinder(double radius, double height, int segments, int rings) {
  Builder b;
  auto at = [&](double r, double y, int s) {
    const double angle = 2 * std::numbers::pi * s / segments;
    return Eigen::Vector3d(r * std::cos(angle), y, -r * std::sin(angle));
  };
  // One profile line from the middle of the bottom to the middle of the top, turned about the axis.
  const int cap = std::max(1, segments / 8);
  std::vector<std::pair<double, double>> profile;
  for (int i = 1; i <= cap; ++i) profile.emplace_back(radius * i / cap, 0);
  for (int i = 1; i <= rings; ++i) profile.emplace_back(radius, height * i / rings);
  for (int i = cap - 1; i >= 1; --i) profile.emplace_back(radius * i / cap, height);
  const int bottom = b.add({0, 0, 0});
  const int top = b.add({0, height, 0});
  std::vector<int> last;
  for (const auto& [r, y] : profile) {
    std::vector<int> ring;
    for (int s = 0; s < segments; ++s) ring.push_back(b.add(at(r, y, s)));
    for (int s = 0; s < segments; ++s) {
      const auto i = static_cast<size_t>(s), j = static_cast<size_t>((s + 1) % segments);
      if (last.empty()) {
        b.faces.emplace_back(bottom, ring[j], ring[i]);
      } else {
        b.quad(last[i], last[j], ring[j], ring[i]);
      }
    }
    last = ring;
  }
  for (int s = 0; s < segments; ++s) {
    b.faces.emplace_back(top, last[static_cast<size_t>(s)], last[static_cast<size_t>((s + 1) % segments)]);
  }
  return b.mesh();
}

Mesh torus(double major_radius, double minor_radius, int major_segments, int minor_segments) {
  Builder b;
  for (int i = 0; i < major_segments; ++i) {
    const double u = 2 * std::numbers::pi * i / major_segments;
    for (int j = 0; j < minor_segments; ++j) {
      const double v = 2 * std::numbers::pi * j / minor_segments;
      const double r = major_radius + minor_radius * std::cos(v);
      b.add({r * std::cos(u), r * std::sin(u), minor_radius * std::sin(v)});
    }
  }
  auto id = [&](int i, int j) { return (i % major_segments) * minor_segments + j % minor_segments; };
  for (int i = 0; i < major_segments; ++i) {
    for (int j = 0; j < minor_segments; ++j) b.quad(id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1));
  }
  return b.mesh();
}

Mesh box(const Eigen::Vector3d& size, int cells) {
  Builder b;
  std::map<std::array<int, 3>, int> ids;
  auto id = [&](std::array<int, 3> at) {
    const auto [found, fresh] = ids.try_emplace(at, 0);
    if (fresh) found->second = b.add(size.cwiseProduct(Eigen::Vector3d(at[0], at[1], at[2])) / cells);
    return found->second;
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (int side : {0, cells}) {
      for (int i = 0; i < cells; ++i) {
        for (int j = 0; j < cells; ++j) {
          auto corner = [&](int di, int dj) {
            std::array<int, 3> at{};
            at[static_cast<size_t>(axis)] = side;
            at[static_cast<size_t>((axis + 1) % 3)] = i + di;
            at[static_cast<size_t>((axis + 2) % 3)] = j + dj;
            return id(at);
          };
          const int p = corner(0, 0), q = corner(1, 0), r = corner(1, 1), s = corner(0, 1);
          side == 0 ? b.quad(p, s, r, q) : b.quad(p, q, r, s);
        }
      }
    }
  }
  return b.mesh();
}

Mesh sheet(int cells) {
  Builder b;
  for (int i = 0; i <= cells; ++i) {
    for (int j = 0; j <= cells; ++j) b.add({double(j) / cells, double(i) / cells, 0});
  }
  auto id = [&](int i, int j) { return i * (cells + 1) + j; };
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) b.quad(id(i, j), id(i, j + 1), id(i + 1, j + 1), id(i + 1, j));
  }
  return b.mesh();
}

Mesh joined(const Mesh& a, const Mesh& b) {
  Mesh result{Positions(a.positions.rows() + b.positions.rows(), 3),
              Triangles(a.triangles.rows() + b.triangles.rows(), 3)};
  result.positions << a.positions, b.positions;
  result.triangles << a.triangles, (b.triangles.array() + static_cast<int>(a.positions.rows())).matrix();
  return result;
}

Mesh transformed(const Mesh& mesh, double scale, const Eigen::Vector3d& translation) {
  return {(scale * mesh.positions).rowwise() + translation.transpose(), mesh.triangles};
}

Gesture move_top(const Mesh& mesh, const Eigen::Vector3d& by) {
  Eigen::Index low = 0, high = 0;
  mesh.positions.col(1).minCoeff(&low);
  mesh.positions.col(1).maxCoeff(&high);
  Gesture gesture;
  gesture.add(static_cast<int>(low), mesh.positions.row(low));
  gesture.add(static_cast<int>(high), mesh.positions.row(high).transpose() + by);
  return gesture;
}

double volume(const Mesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles.rowwise()) {
    const Eigen::Vector3d a = mesh.positions.row(t[0]), b = mesh.positions.row(t[1]), c = mesh.positions.row(t[2]);
    sum += a.dot(b.cross(c)) / 6;
  }
  return sum;
}

Mesh awkward() {
  const Mesh one = sheet(4);
  Mesh mesh = one;
  for (const double angle : {2.0, 4.0}) {
    Mesh other = one;
    other.positions = one.positions * Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()).toRotationMatrix().transpose();
    if (angle > 3) other.triangles = Triangles(one.triangles.rowwise().reverse());
    mesh = joined(mesh, other);
  }
  const Eigen::Index count = mesh.triangles.rows();
  mesh.triangles.conservativeResize(count + 2, 3);
  mesh.triangles.row(count) = mesh.triangles.row(3);
  mesh.triangles.row(count + 1) << 0, 1, 0;
  mesh.positions.conservativeResize(mesh.positions.rows() + 1, 3);
  mesh.positions.bottomRows(1) << 0.3, 0.4, 2;
  return mesh;
}

}  // namespace swage::test
