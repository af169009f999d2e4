// Relief from a normal map: the targets that its directions are, seen from the triangles' frames.
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "measures.h"
#include "messages.h"
#include "sampled.h"
#include "swage/error.h"

namespace swage {
namespace {

using Eigen::Index;
using Eigen::RowVector3d;
using Eigen::Vector3d;

constexpr int kMostSamples = 16;  // Along a side.

using Corners = Eigen::Matrix<double, 3, 2>;

Corners corners_of(const TextureCoordinates& texture, Index t) {
  Corners corners;
  for (int k = 0; k < 3; ++k) corners.row(k) = texture.points.row(texture.triangles(t, k));
  return corners;
}

/// Twice the area in the picture, negative where it is mirrored there.
double twice_area(const Corners& uv) {
  Eigen::Matrix2d sides;
  sides << uv.row(1) - uv.row(0), uv.row(2) - uv.row(0);
  return sides.determinant();
}

/// #T × 3: where u grows, unit; zero where it cannot be told.
Positions tangents_of(const Mesh& mesh, const TextureCoordinates& texture) {
  Positions tangents(mesh.triangles.rows(), 3);
  for (Index t = 0; t < tangents.rows(); ++t) {
    const Corners uv = corners_of(texture, t);
    const RowVector3d a = mesh.positions.row(mesh.triangles(t, 0));
    const RowVector3d ab = mesh.positions.row(mesh.triangles(t, 1)) - a;
    const RowVector3d ac = mesh.positions.row(mesh.triangles(t, 2)) - a;
    const RowVector3d along = ab * (uv(2, 1) - uv(0, 1)) - ac * (uv(1, 1) - uv(0, 1));
    const double area = twice_area(uv);
    tangents.row(t) =
        area == 0 ? RowVector3d::Zero() : RowVector3d(std::copysign(1.0, area) * along.stableNormalized());
  }
  return tangents;
}

/// Numbers of corners: one of those that share vertex, texture point and handedness.
Triangles shared_corners(const Mesh& mesh, const TextureCoordinates& texture, int& count) {
  using Key = std::array<int, 3>;
  std::vector<std::pair<Key, Index>> keys;
  keys.reserve(static_cast<size_t>(3 * mesh.triangles.rows()));
  for (Index t = 0; t < mesh.triangles.rows(); ++t) {
    const int hand = twice_area(corners_of(texture, t)) < 0;
    for (int k = 0; k < 3; ++k) keys.push_back({{mesh.triangles(t, k), texture.triangles(t, k), hand}, 3 * t + k});
  }
  std::sort(keys.begin(), keys.end());
  Triangles numbers(mesh.triangles.rows(), 3);
  count = 0;
  for (size_t i = 0; i < keys.size(); ++i) {
    if (i > 0 && keys[i].first != keys[i - 1].first) ++count;
    numbers(keys[i].second / 3, keys[i].second % 3) = count;
  }
  ++count;
  return numbers;
}

class Unbaking {
 public:
  Unbaking(const Mesh& mesh, const TextureCoordinates& texture, const NormalPicture& map,
           const NormalMapOptions& options)
      : texture_(texture), map_(map), options_(options), normals_(unit_normals(mesh.positions, mesh.triangles)) {
    if (options_.space == NormalSpace::object) return;
    tangents_ = tangents_of(mesh, texture);
    const Positions areas = area_vectors(mesh.positions, mesh.triangles);
    int count = 0;
    corners_ = shared_corners(mesh, texture, count);
    corner_tangents_ = Positions::Zero(count, 3);
    for (Index t = 0; t < corners_.rows(); ++t) {
      for (const int corner : corners_.row(t)) corner_tangents_.row(corner) += areas.row(t).norm() * tangents_.row(t);
    }
  }

  /// Unit; zero where the map has none over all of the triangle.
  RowVector3d target(Index t) const {
    const bool in_tangent_space = options_.space == NormalSpace::tangent;
    if (in_tangent_space && tangents_.row(t).isZero(0)) return normals_.row(t);
    const Corners uv = corners_of(texture_, t);
    const double pixels = std::abs(twice_area(uv)) / 2 * map_.width * map_.height;
    const int sides = static_cast<int>(std::clamp(std::ceil(std::sqrt(pixels)), 2.0, double{kMostSamples}));
    RowVector3d sum = RowVector3d::Zero();
    const auto add = [&](const Vector3d& inside) {
      const Vector3d normal = at(inside.transpose() * uv);
      if (!normal.isZero(0)) sum += in_tangent_space ? RowVector3d(from_frame(t, inside, normal)) : normal.transpose();
    };
    // The middles of equal triangles that it is cut in.
    for (int i = 0; i < sides; ++i) {
      for (int j = 0; i + j < sides; ++j) {
        const Vector3d corner(i, j, sides - 1 - i - j);
        add((corner.array() + 1.0 / 3).matrix() / sides);
        if (i + j < sides - 1) add((corner + Vector3d(2.0 / 3, 2.0 / 3, -1.0 / 3)) / sides);
      }
    }
    return sum.stableNormalized();
  }

 private:
  Vector3d at(const Eigen::RowVector2d& uv) const {
    const Vector3d normal =
        sampled(map_, {0, map_.width, true}, {0, map_.height, true}, (uv[0] - std::floor(uv[0])) * map_.width,
                (1 - (uv[1] - std::floor(uv[1]))) * map_.height);
    return normal.stableNormalized();
  }

  RowVector3d from_frame(Index t, const Vector3d& inside, const Vector3d& normal) const {
    const Vector3d up = normals_.row(t).transpose();
    Vector3d along = Vector3d::Zero();
    for (int k = 0; k < 3; ++k)
      along += inside[k] * corner_tangents_.row(corners_(t, k)).stableNormalized().transpose();
    along -= up.dot(along) * up;
    // Across a pole they may cancel.
    if (along.norm() < 1e-6) along = tangents_.row(t).transpose();
    along.normalize();
    const double hand = twice_area(corners_of(texture_, t)) < 0 ? -1 : 1;
    const double y = (options_.green_down ? -1 : 1) * hand * normal.y();
    return (normal.x() * along + y * up.cross(along) + normal.z() * up).transpose();
  }

  const TextureCoordinates& texture_;
  const NormalPicture& map_;
  const NormalMapOptions& options_;
  Positions normals_, tangents_, corner_tangents_;
  Triangles corners_;
};

void check_texture(const Mesh& mesh, const TextureCoordinates& texture) {
  if (texture.triangles.rows() != mesh.triangles.rows()) {
    throw InvalidInput("unbaked: texture: " + std::to_string(texture.triangles.rows()) +
                       " triangles, but the mesh has " + std::to_string(mesh.triangles.rows()) + "; give one for each");
  }
  for (Eigen::Index t = 0; t < texture.triangles.rows(); ++t) {
    const auto corners = texture.triangles.row(t);
    if (corners.minCoeff() >= 0 && corners.maxCoeff() < texture.points.rows()) continue;
    throw InvalidInput("unbaked: texture: triangle " + std::to_string(t) + " names none of the " +
                       std::to_string(texture.points.rows()) + " points; mend it");
  }
  if (const Eigen::Index row = first_not_finite(texture.points); row >= 0) {
    throw InvalidInput("unbaked: texture: point " + std::to_string(row) + " is not finite; mend it");
  }
}

}  // namespace

const char* to_string(NormalSpace space) { return space == NormalSpace::tangent ? "tangent" : "object"; }

GivenNormals unbaked(const Mesh& mesh, const TextureCoordinates& texture, const NormalPicture& map,
                     const NormalMapOptions& options) {
  check(mesh.positions, mesh.triangles);
  check_texture(mesh, texture);
  check("unbaked", map);
  const Unbaking unbaking(mesh, texture, map, options);
  GivenNormals result{Positions(mesh.triangles.rows(), 3), true};
#pragma omp parallel for schedule(static)
  for (Index t = 0; t < result.normals.rows(); ++t) result.normals.row(t) = unbaking.target(t);
  return result;
}

}  // namespace swage
