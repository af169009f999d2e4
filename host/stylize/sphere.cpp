#include "sphere.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "measures.h"
#include "nearest.h"

namespace swage {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kSeam = 1e-9;

Matrix3d corners(const Positions& directions, const Triangles& triangles, int t) {
  Matrix3d columns;
  for (int k = 0; k < 3; ++k) columns.col(k) = directions.row(triangles(t, k)).transpose();
  return columns;
}

/// Triangles between the points of a sphere, by the direction in which they are seen from its middle.
class SphereTriangles {
 public:
  explicit SphereTriangles(const SphereMap& map)
      : directions_(normalised(map.directions)),
        triangles_(map.triangles),
        normals_(normalised(map.normals)),
        tree_(directions_, triangles_) {
    for (int t = 0; t < triangles_.rows(); ++t) {
      const Matrix3d abc = corners(directions_, triangles_, t);
      const Vector3d normal = (abc.col(1) - abc.col(0)).cross(abc.col(2) - abc.col(0)).stableNormalized();
      inner_radius_ = std::min(inner_radius_, std::abs(normal.dot(abc.col(0))));
    }
  }

  Eigen::RowVector3d normal(const Vector3d& unit) const {
    Eigen::AlignedBox3d ray(inner_radius_ * unit);
    ray.extend(unit);
    // Seams may be open by rounding.
    ray.min().array() -= kSeam;
    ray.max().array() += kSeam;
    int met = -1;
    double best = -std::numeric_limits<double>::infinity();
    Vector3d at = Vector3d::Zero();
    tree_.near(ray, [&](int t) {
      // Of the cone over the triangle: none is negative within.
      Vector3d inside = corners(directions_, triangles_, t).partialPivLu().solve(unit);
      inside /= inside.sum();
      const double least = inside.minCoeff();
      if (!(least > best || (least == best && t < met))) return;
      best = least;
      met = t;
      at = inside;
    });
    if (met < 0) return nearest(unit);
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    for (int k = 0; k < 3; ++k) sum += std::max(0.0, at[k]) * normals_.row(triangles_(met, k));
    return sum.stableNormalized();
  }

 private:
  /// Where triangles leave a gap.
  Eigen::RowVector3d nearest(const Vector3d& unit) const {
    const Foot foot = tree_.nearest(unit);
    Eigen::Index corner = 0;
    foot.barycentric.maxCoeff(&corner);
    return normals_.row(triangles_(foot.triangle, corner));
  }

  Positions directions_;
  Triangles triangles_;
  Positions normals_;
  TriangleTree tree_;
  double inner_radius_ = 1;  // Of the ball within all triangles.
};

Positions of_nearest_points(const SphereMap& map, const Positions& normals, const Backend& backend) {
  Eigen::VectorXi nearest;
  backend.closest_normal(normalised(map.directions))->find(normals, nearest);
  return normalised(map.normals)(nearest, Eigen::all);
}

}  // namespace

Positions on_sphere(const SphereMap& map, const Positions& normals, const Backend& backend) {
  if (map.nearest) return of_nearest_points(map, normals, backend);
  const SphereTriangles sphere(map);
  Positions result(normals.rows(), 3);
#pragma omp parallel for schedule(static)
  for (Index n = 0; n < normals.rows(); ++n) result.row(n) = sphere.normal(normals.row(n).transpose());
  return result;
}

int folded_triangles(const Positions& directions, const Triangles& triangles) {
  int folded = 0;
  for (int t = 0; t < triangles.rows(); ++t) {
    if (!(corners(directions, triangles, t).determinant() > 0)) ++folded;
  }
  return folded;
}

}  // namespace swage
