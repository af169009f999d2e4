// Normal captures (Liu, Jacobson 2021, section 3): spheres painted with the normals of a style.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "adjacency.h"
#include "measures.h"
#include "sampled.h"
#include "sphere.h"
#include "swage/error.h"

namespace swage {
namespace {

using Eigen::Index;
using Eigen::RowVector3d;
using Eigen::Vector3d;

constexpr double kLargestGap = 0.05;  // Of the sphere.
constexpr int kFewestSubdivisions = 3, kMostSubdivisions = 7;

[[noreturn]] void refuse(const std::string& what) { throw InvalidInput("normal_capture: " + what); }

std::string percent(double share) { return std::to_string(std::lround(100 * share)) + " %"; }

/// Each triangle in four, on the unit sphere.
Mesh finer(const Mesh& sphere) {
  const Edges edges = edges_of(sphere.triangles);
  const auto first = static_cast<int>(sphere.positions.rows());
  Mesh result{Positions(first + edges.vertices.rows(), 3), Triangles(4 * sphere.triangles.rows(), 3)};
  result.positions << sphere.positions, normalised(sphere.positions(edges.vertices.col(0), Eigen::all) +
                                                   sphere.positions(edges.vertices.col(1), Eigen::all));
  for (Index t = 0; t < sphere.triangles.rows(); ++t) {
    const Eigen::RowVector3i a = sphere.triangles.row(t);
    const Eigen::RowVector3i m = edges.triangle_edges.row(t).array() + first;
    result.triangles.middleRows(4 * t, 4) << a[0], m[0], m[2], a[1], m[1], m[0], a[2], m[2], m[1], m[0], m[1], m[2];
  }
  return result;
}

/// About as many points as a quarter of the pixels.
Mesh sphere_for(const NormalPicture& picture) {
  Mesh sphere = style_shape(StyleShape::icosahedron);
  double due = static_cast<double>(picture.width) * picture.height / 4;
  for (int k = 0; k < kMostSubdivisions; ++k) {
    if (k >= kFewestSubdivisions && static_cast<double>(sphere.positions.rows()) >= due) break;
    sphere = finer(sphere);
  }
  return sphere;
}

Vector3d in_equirectangular(const NormalPicture& picture, const Vector3d& direction) {
  const double u = 0.5 + std::atan2(direction.x(), direction.z()) / (2 * std::numbers::pi);
  const double v = std::acos(std::clamp(direction.y(), -1.0, 1.0)) / std::numbers::pi;
  return sampled(picture, {0, picture.width, true}, {0, picture.height}, u * picture.width, v * picture.height);
}

Vector3d in_disc(const NormalPicture& picture, bool is_left, const Eigen::Vector2d& at) {
  const double radius = picture.height / 2.0;
  const Pixels disc{is_left ? 0 : picture.height, picture.height};
  const double x = radius * (1 + (is_left ? at.x() : -at.x()));
  return sampled(picture, disc, {0, picture.height}, x, radius * (1 - at.y()));
}

/// Within a pixel of the rim, which is seen at a slant and partly beyond it, between what both discs show there.
Vector3d in_hemispheres(const NormalPicture& picture, const Vector3d& direction) {
  const Eigen::Vector2d at = direction.head<2>();
  const double last = 1 - 2.0 / picture.height;
  if (at.norm() <= last) return in_disc(picture, direction.z() > 0, at);
  const Eigen::Vector2d rim = at.normalized() * last;
  const Vector3d left = in_disc(picture, true, rim), right = in_disc(picture, false, rim);
  if (left.isZero(0) || right.isZero(0)) return left + right;
  const double share = std::asin(direction.z()) / std::acos(last);  // -1 to 1
  return (1 + share) * left + (1 - share) * right;
}

/// Area of the unit sphere that a triangle is before.
double solid_angle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  return 2 * std::atan2(a.dot(b.cross(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
}

/// Of each triangle, as part of the whole sphere.
Eigen::VectorXd shares(const SphereMap& map) {
  Eigen::VectorXd result(map.triangles.rows());
  for (Index t = 0; t < result.size(); ++t) {
    const auto corner = [&](int k) { return Vector3d(map.directions.row(map.triangles(t, k)).transpose()); };
    result[t] = solid_angle(corner(0), corner(1), corner(2)) / (4 * std::numbers::pi);
  }
  return result;
}

/// Points without a normal take the mean of those beside them, ring after ring.
void fill_gaps(SphereMap& map, const char* remedy) {
  const auto is_gap = [&](Index i) { return map.normals.row(i).isZero(0); };
  const Eigen::VectorXd share = shares(map);
  double gap = 0;
  RowVector3d where = RowVector3d::Zero();
  for (Index t = 0; t < map.triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      if (!is_gap(map.triangles(t, k))) continue;
      gap += share[t] / 3;
      where += share[t] * map.directions.row(map.triangles(t, k));
    }
  }
  if (gap > kLargestGap) {
    std::ostringstream middle;
    const auto rounded = [](double x) { return std::round(100 * x) / 100 + 0.0; };  // Not -0.
    middle << where.stableNormalized().unaryExpr(rounded).format(Eigen::IOFormat(2, Eigen::DontAlignCols, ", "));
    refuse(percent(gap) + " of the sphere has no normal, around (" + middle.str() + "); at most " +
           percent(kLargestGap) + " may be missing: " + remedy);
  }
  if (gap == 0) return;
  const Lists rings = one_rings(edges_of(map.triangles), static_cast<int>(map.directions.rows()));
  for (bool grows = true; grows;) {
    grows = false;
    const Positions known = map.normals;
    for (int i = 0; i < rings.size(); ++i) {
      if (!is_gap(i)) continue;
      RowVector3d sum = RowVector3d::Zero();
      for (const int j : rings[i]) sum += known.row(j);
      map.normals.row(i) = sum.stableNormalized();
      // Where they cancel, any of them.
      for (const int j : rings[i]) {
        if (is_gap(i)) map.normals.row(i) = known.row(j);
      }
      grows = grows || !is_gap(i);
    }
  }
}

/// Points that nothing is said of need a direction all the same.
void fill_unused(SphereMap& map) {
  for (Index i = 0; i < map.directions.rows(); ++i) {
    if (map.directions.row(i).isZero(0)) map.directions.row(i) = RowVector3d::UnitZ();
    if (map.normals.row(i).isZero(0)) map.normals.row(i) = map.directions.row(i);
  }
}

RowVector3d centre_of(const Mesh& mesh, const Eigen::VectorXd& areas) {
  RowVector3d sum = RowVector3d::Zero();
  for (Index t = 0; t < areas.size(); ++t) {
    for (const int v : mesh.triangles.row(t)) sum += areas[t] / 3 * mesh.positions.row(v);
  }
  return sum / areas.sum();
}

void check_cover(const SphereMap& map) {
  const auto folded = static_cast<Index>(folded_triangles(map.directions, map.triangles));
  if (folded > 0) {
    refuse("sphere: " + std::to_string(folded) + " of " + std::to_string(map.triangles.rows()) +
           " triangles are not seen counter-clockwise from its middle: paint a sphere, or flip its faces outwards");
  }
  const double cover = shares(map).sum();
  if (std::abs(cover - 1) > kLargestGap) {
    refuse("sphere: its triangles cover the sphere " + percent(cover) + ", not once: paint a whole sphere");
  }
}

}  // namespace

const char* to_string(CaptureLayout layout) {
  return layout == CaptureLayout::equirectangular ? "equirectangular" : "hemispheres";
}

SphereMap normal_capture(const NormalPicture& picture, CaptureLayout layout) {
  check("normal_capture", picture);
  if (picture.width != 2 * picture.height) {
    refuse("picture: " + std::to_string(picture.width) + " x " + std::to_string(picture.height) +
           " pixels; in the layout " + to_string(layout) + " it is twice as wide as high: scale it");
  }
  if (picture.height < 4)
    refuse("picture: " + std::to_string(picture.height) + " rows of pixels, fewer than 4: take a larger one");
  Mesh sphere = sphere_for(picture);
  SphereMap map{std::move(sphere.positions), std::move(sphere.triangles), {}};
  map.normals.resize(map.directions.rows(), 3);
#pragma omp parallel for schedule(static)
  for (Index i = 0; i < map.directions.rows(); ++i) {
    const Vector3d direction = map.directions.row(i).transpose();
    map.normals.row(i) = (layout == CaptureLayout::equirectangular ? in_equirectangular(picture, direction)
                                                                   : in_hemispheres(picture, direction))
                             .stableNormalized();
  }
  fill_gaps(map, "paint all of it, in opaque colours of normals, or name the picture's other layout");
  return map;
}

SphereMap normal_capture(const Mesh& sphere, const Positions& normals) {
  check(sphere.positions, sphere.triangles);
  if (normals.rows() != sphere.positions.rows()) {
    refuse("normals: " + std::to_string(normals.rows()) + " rows, but there are " +
           std::to_string(sphere.positions.rows()) + " vertices: give one for each");
  }
  const Eigen::VectorXd areas = area_vectors(sphere.positions, sphere.triangles).rowwise().norm();
  if (!(areas.sum() > 0)) refuse("sphere: no triangle has an area: paint a whole sphere");
  SphereMap map;
  map.directions = normalised(sphere.positions.rowwise() - centre_of(sphere, areas));
  map.normals = normals;
  for (auto normal : map.normals.rowwise()) {
    if (!normal.allFinite()) normal.setZero();
  }
  map.normals = normalised(std::move(map.normals));
  // Poles of spheres by latitude and longitude may have triangles without area.
  std::vector<int> with_area;
  for (int t = 0; t < sphere.triangles.rows(); ++t) {
    if (has_area(sphere.positions, sphere.triangles.row(t))) with_area.push_back(t);
  }
  map.triangles = sphere.triangles(with_area, Eigen::all);
  check_cover(map);
  fill_gaps(map, "give the other vertices normals too");
  fill_unused(map);
  return map;
}

}  // namespace swage
