// Solids put in their places, and a plate with holes.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "shapes.h"
#include "solids.h"

namespace swage::test {
namespace {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Quadrilaterals whose equal corners are one.
class Welded {
 public:
  void quad(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
    const int i = at(a), j = at(b), k = at(c), l = at(d);
    triangles_.emplace_back(i, j, k);
    triangles_.emplace_back(i, k, l);
  }
  Mesh mesh() const {
    Mesh result{Positions(points_.size(), 3), Triangles(triangles_.size(), 3)};
    for (size_t i = 0; i < points_.size(); ++i) result.positions.row(static_cast<Index>(i)) = points_[i];
    for (size_t i = 0; i < triangles_.size(); ++i) result.triangles.row(static_cast<Index>(i)) = triangles_[i];
    return result;
  }

 private:
  int at(const Vector3d& point) {
    const Vector3d steps = point * 1e6;
    const auto [found, fresh] = numbers_.try_emplace(
        {std::llround(steps[0]), std::llround(steps[1]), std::llround(steps[2])}, static_cast<int>(points_.size()));
    if (fresh) points_.push_back(point);
    return found->second;
  }
  Path points_;
  std::vector<Eigen::Vector3i> triangles_;
  std::map<std::array<long long, 3>, int> numbers_;
};

}  // namespace

Mesh plate(int columns, int rows, double side, double thickness, const std::vector<Eigen::Vector2i>& holed,
           double hole_radius, int around) {
  Welded welded;
  const int cells = around / 4;
  const auto at = [&](const Vector2d& point, double part) {
    return Vector3d(point[0] - columns * side / 2, (part - 0.5) * thickness, point[1] - rows * side / 2);
  };
  // Above, and turned over below.
  const auto both = [&](const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
    welded.quad(at(a, 1), at(b, 1), at(c, 1), at(d, 1));
    welded.quad(at(d, 0), at(c, 0), at(b, 0), at(a, 0));
  };
  const auto wall = [&](const Vector2d& a, const Vector2d& b) { welded.quad(at(a, 0), at(b, 0), at(b, 1), at(a, 1)); };
  for (int column = 0; column < columns; ++column) {
    for (int row = 0; row < rows; ++row) {
      const Vector2d corner(column * side, row * side), middle = corner + Vector2d::Constant(side / 2);
      if (std::find(holed.begin(), holed.end(), Eigen::Vector2i(column, row)) == holed.end()) {
        for (int i = 0; i < cells; ++i) {
          for (int j = 0; j < cells; ++j) {
            const auto point = [&](int x, int y) { return Vector2d(corner + Vector2d(x, y) * side / cells); };
            both(point(i, j), point(i, j + 1), point(i + 1, j + 1), point(i + 1, j));
          }
        }
        continue;
      }
      // Rings from the hole to the square.
      const auto point = [&](int i, double part) {
        const double step = (i % cells) / static_cast<double>(cells),
                     angle = 2 * std::numbers::pi * (i + 0.5 * cells) / around;
        const Vector2d sides[4] = {{1 - step, 1}, {0, 1 - step}, {step, 0}, {1, step}};
        const Vector2d outer = corner + side * sides[(i / cells) % 4];
        const Vector2d inner = middle + hole_radius * Vector2d(std::cos(angle), std::sin(angle));
        return Vector2d(inner + part * (outer - inner));
      };
      for (int i = 0; i < around; ++i) {
        for (int k = 0; k < cells / 2; ++k) {
          const double from = 2.0 * k / cells, to = 2.0 * (k + 1) / cells;
          both(point(i, from), point((i + 1) % around, from), point((i + 1) % around, to), point(i, to));
        }
        wall(point(i, 0), point((i + 1) % around, 0));
      }
    }
  }
  const double width = columns * side, depth = rows * side;
  for (int i = 0; i < columns * cells; ++i) {
    const double from = side * i / cells, to = side * (i + 1) / cells;
    wall({to, 0}, {from, 0});
    wall({from, depth}, {to, depth});
  }
  for (int i = 0; i < rows * cells; ++i) {
    const double from = side * i / cells, to = side * (i + 1) / cells;
    wall({0, from}, {0, to});
    wall({width, to}, {width, from});
  }
  return welded.mesh();
}

Mesh placed(const Mesh& mesh, const Eigen::Affine3d& by) {
  Mesh result = {(mesh.positions * by.linear().transpose()).rowwise() + by.translation().transpose(), mesh.triangles};
  if (by.linear().determinant() < 0) result.triangles.col(1).swap(result.triangles.col(2));
  return result;
}

Mesh moved(const Mesh& mesh, const Vector3d& by) { return {mesh.positions.rowwise() + by.transpose(), mesh.triangles}; }

Mesh quarter_turned(int axis, const Mesh& mesh) {
  Mesh result = mesh;
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  result.positions.col(u) = -mesh.positions.col(v);
  result.positions.col(v) = mesh.positions.col(u);
  return result;
}

Mesh about(int axis, const Mesh& mesh) {
  // Coordinates change places, which no rounding touches.
  Mesh result = mesh;
  for (int u = 0; u < 3; ++u) result.positions.col((u + axis + 2) % 3) = mesh.positions.col(u);
  return result;
}

std::vector<Part> Assembled::named(const std::string& beginning) const {
  std::vector<Part> found;
  for (const Part& part : parts) {
    if (part.name.starts_with(beginning)) found.push_back(part);
  }
  return found;
}

int Assembler::steps(int count) const { return std::max(1, static_cast<int>(std::lround(count * detail_))); }

void Assembler::add(const std::string& name, Mesh part) {
  names_.push_back(name);
  meshes_.push_back(std::move(part));
}

void Assembler::add_mirrored(const std::string& name, const Mesh& part, int axis) {
  add(name, part);
  Mesh image = part;
  image.positions.col(axis) *= -1;
  image.triangles.col(1).swap(image.triangles.col(2));
  add(name, std::move(image));
}

Assembled Assembler::assembled() const {
  Assembled result;
  Index vertices = 0, triangles = 0;
  for (const Mesh& mesh : meshes_) {
    vertices += mesh.positions.rows();
    triangles += mesh.triangles.rows();
  }
  result.mesh = {Positions(vertices, 3), Triangles(triangles, 3)};
  vertices = triangles = 0;
  for (size_t i = 0; i < meshes_.size(); ++i) {
    const Mesh& mesh = meshes_[i];
    result.parts.push_back({names_[i], vertices, mesh.positions.rows()});
    result.mesh.positions.middleRows(vertices, mesh.positions.rows()) = mesh.positions;
    result.mesh.triangles.middleRows(triangles, mesh.triangles.rows()) =
        mesh.triangles.array() + static_cast<int>(vertices);
    vertices += mesh.positions.rows();
    triangles += mesh.triangles.rows();
  }
  return result;
}

}  // namespace swage::test
