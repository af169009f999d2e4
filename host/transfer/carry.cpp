#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "foot.h"
#include "swage/error.h"
#include "swage/transfer.h"

namespace swage {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// Twice the area over the longest side's square, below which a triangle says little about what happens beside it.
constexpr double kNoArea = 1e-6;

void check_count(const char* argument, Index rows, Index due) {
  if (rows == due) return;
  throw InvalidInput(std::string("carry: ") + argument + ": " + std::to_string(rows) + " rows, but the surface has " +
                     std::to_string(due) + "; give one for each");
}

void check_attachments(const Attachments& attachments, Index triangle_count) {
  const Index count = attachments.triangles.size();
  if (attachments.barycentric.rows() != count || attachments.offsets.rows() != count) {
    throw InvalidInput("carry: attachments: triangles, barycentric and offsets have " + std::to_string(count) + ", " +
                       std::to_string(attachments.barycentric.rows()) + " and " +
                       std::to_string(attachments.offsets.rows()) + " rows; leave them as attach() gives them");
  }
  for (Index i = 0; i < count; ++i) {
    const std::string row = "carry: attachments: row " + std::to_string(i);
    const int t = attachments.triangles[i];
    if (t < 0 || t >= triangle_count) {
      throw InvalidInput(row + " names triangle " + std::to_string(t) + ", but triangles run from 0 to " +
                         std::to_string(triangle_count - 1) + "; is it of another surface?");
    }
    if (!attachments.barycentric.row(i).allFinite() || !attachments.offsets.row(i).allFinite()) {
      throw InvalidInput(row + " is not finite; mend it");
    }
  }
}

void check_transforms(const Transforms& transforms, Index triangle_count) {
  check_count("transforms", transforms.rows(), triangle_count);
  for (Index t = 0; t < triangle_count; ++t) {
    if (!transforms.row(t).allFinite()) {
      throw InvalidInput("carry: transforms: row " + std::to_string(t) + " is not finite; mend it");
    }
  }
}

/// A triangle's sides from its first corner, unit normal, and twice its area.
struct Frame {
  Vector3d to_b, to_c, normal;
  double area;
  bool has_area;

  Frame(const PositionsRef& positions, const TrianglesRef& triangles, Index t)
      : to_b(positions.row(triangles(t, 1)) - positions.row(triangles(t, 0))),
        to_c(positions.row(triangles(t, 2)) - positions.row(triangles(t, 0))),
        normal(to_b.cross(to_c)),
        area(normal.norm()) {
    normal /= area;
    has_area = area > kNoArea * std::max({to_b.squaredNorm(), to_c.squaredNorm(), (to_c - to_b).squaredNorm()});
  }
};

Matrix3d deformation_gradient(const Frame& rest, const Frame& moved) {
  if (!rest.has_area || !moved.has_area) return Matrix3d::Identity();
  // What changed, so that nothing moved is the identity exactly, however badly shaped the triangle.
  const Vector3d change = std::sqrt(moved.area / rest.area) * moved.normal - rest.normal;
  return Matrix3d::Identity() + (moved.to_b - rest.to_b) * (rest.to_c.cross(rest.normal) / rest.area).transpose() +
         (moved.to_c - rest.to_c) * (rest.normal.cross(rest.to_b) / rest.area).transpose() +
         change * rest.normal.transpose();
}

Transforms deformation_gradients(const TrianglesRef& triangles, const PositionsRef& rest, const PositionsRef& moved) {
  Transforms gradients(triangles.rows(), 9);
#pragma omp parallel for schedule(static)
  for (Index t = 0; t < triangles.rows(); ++t) {
    const Matrix3d gradient = deformation_gradient({rest, triangles, t}, {moved, triangles, t});
    gradients.row(t) = gradient.reshaped<Eigen::RowMajor>();
  }
  return gradients;
}

}  // namespace

Positions carry(const Attachments& attachments, const TrianglesRef& surface_triangles, const PositionsRef& rest,
                const PositionsRef& moved, const Transforms* transforms) {
  check(rest, surface_triangles);
  check(moved, surface_triangles);
  check_count("moved", moved.rows(), rest.rows());
  check_attachments(attachments, surface_triangles.rows());
  if (transforms) check_transforms(*transforms, surface_triangles.rows());
  Transforms gradients;
  if (!transforms) gradients = deformation_gradients(surface_triangles, rest, moved);
  const Transforms& maps = transforms ? *transforms : gradients;

  Positions carried(attachments.triangles.size(), 3);
#pragma omp parallel for schedule(static)
  for (Index i = 0; i < carried.rows(); ++i) {
    const int t = attachments.triangles[i];
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> map(maps.row(t).data());
    carried.row(i) = point_at(moved, surface_triangles.row(t), attachments.barycentric.row(i)) +
                     attachments.offsets.row(i) * map.transpose();
  }
  return carried;
}

}  // namespace swage
