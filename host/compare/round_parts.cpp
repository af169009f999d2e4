// Cylinders and spheres, and how round an edit leaves them.
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>

#include "adjacency.h"
#include "measures.h"
#include "parts.h"
#include "pieces.h"

namespace swage {
namespace {

constexpr double kRound = 0.01;  // In radii: how far a vertex of a round part is off it at most.
// Variances of unit normals: along the axis of a cylinder or cone there is none, across it and of a sphere there is.
constexpr double kNoSpread = 1e-4, kSomeSpread = 1e-3;
constexpr size_t kFewestVertices = 12;

/// A smooth part of the surface, with the vertices that lie on it.
struct Part {
  std::vector<Eigen::Index> triangles;
  std::vector<int> vertices;
  Eigen::VectorXd weights;  ///< Area around each vertex at rest, of sum 1.
  double area = 0;
};

/// What a surface of revolution is fitted to.
struct Fit {
  double radius = 0;     ///< Mean.
  double deviation = 0;  ///< Root mean square, in radii.
  double largest = 0;    ///< In radii.
};

Fit fit_of(const Eigen::ArrayXd& distances, const Eigen::ArrayXd& radii, const Eigen::ArrayXd& weights) {
  Fit fit;
  fit.radius = (weights * radii).sum();
  const Eigen::ArrayXd off = (distances - radii) / fit.radius;
  fit.deviation = std::sqrt((weights * off.square()).sum());
  fit.largest = off.abs().maxCoeff();
  return fit;
}

Eigen::VectorXd weighted_solution(const Eigen::MatrixXd& terms, const Eigen::VectorXd& values,
                                  const Eigen::VectorXd& weights) {
  const Eigen::VectorXd roots = weights.cwiseSqrt();
  return (roots.asDiagonal() * terms).colPivHouseholderQr().solve(roots.asDiagonal() * values);
}

/// |x|² = 2 c x + d.
Fit fit_sphere(const Positions& points, const Eigen::VectorXd& weights) {
  Eigen::MatrixXd terms(points.rows(), 4);
  terms << 2 * points, Eigen::VectorXd::Ones(points.rows());
  const Eigen::VectorXd c = weighted_solution(terms, points.rowwise().squaredNorm(), weights);
  const Eigen::RowVector3d centre = c.head<3>().transpose();
  const double radius = std::sqrt(std::max(0.0, c[3] + centre.squaredNorm()));
  const Eigen::ArrayXd distances = (points.rowwise() - centre).rowwise().norm();
  return fit_of(distances, Eigen::ArrayXd::Constant(points.rows(), radius), weights);
}

/// |p|² = 2 c p + d0 + d1 z + d2 z² with p across the axis and z along it.
Fit fit_revolution(const Positions& points, const Eigen::Vector3d& axis, const Eigen::VectorXd& weights) {
  Eigen::Matrix<double, 3, 2> plane;
  plane.col(0) = axis.unitOrthogonal();
  plane.col(1) = axis.cross(plane.col(0));
  const Eigen::MatrixX2d across = points * plane;
  const Eigen::ArrayXd along = points * axis;
  Eigen::MatrixXd terms(points.rows(), 5);
  terms << 2 * across, Eigen::VectorXd::Ones(points.rows()), along, along.square();
  const Eigen::VectorXd c = weighted_solution(terms, across.rowwise().squaredNorm(), weights);
  const Eigen::RowVector2d centre = c.head<2>().transpose();
  const Eigen::ArrayXd radii = (c[2] + c[3] * along + c[4] * along.square() + centre.squaredNorm()).max(0).sqrt();
  return fit_of((across.rowwise() - centre).rowwise().norm(), radii, weights);
}

/// Of unit normals, weighted by area, about their mean.
Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> normal_spread(const Positions& positions, const Triangles& triangles) {
  const Positions areas = area_vectors(positions, triangles);
  const Eigen::VectorXd sizes = areas.rowwise().norm();
  Positions normals = Positions::Zero(areas.rows(), 3);
  for (Eigen::Index t = 0; t < areas.rows(); ++t) {
    if (sizes[t] > 0) normals.row(t) = areas.row(t) / sizes[t];
  }
  const Eigen::VectorXd weights = sizes / std::max(sizes.sum(), std::numeric_limits<double>::min());
  normals.rowwise() -= (weights.transpose() * normals).eval();
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(
      Eigen::Matrix3d(normals.transpose() * weights.asDiagonal() * normals));
}

/// Points about their box's middle, for the sake of rounding.
Positions centred(const Positions& points) {
  const Eigen::RowVector3d low = points.colwise().minCoeff(), high = points.colwise().maxCoeff();
  return (points.rowwise() - (low + high) / 2);
}

std::vector<Part> parts_of(const Positions& rest, const Triangles& triangles, const Pieces& pieces) {
  const std::vector<int> part_of = components(pieces.mesh.triangles, static_cast<int>(pieces.mesh.positions.rows()));
  std::map<int, Part> found;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    found[part_of[static_cast<size_t>(pieces.mesh.triangles(t, 0))]].triangles.push_back(t);
  }
  const Eigen::VectorXd areas = area_vectors(rest, triangles).rowwise().norm();
  std::vector<Part> parts;
  for (auto& [number, part] : found) {
    std::map<int, double> weights;
    for (Eigen::Index t : part.triangles) {
      for (int v : triangles.row(t)) weights[v] += areas[t];
    }
    part.weights.resize(static_cast<Eigen::Index>(weights.size()));
    for (const auto& [vertex, weight] : weights) {
      part.weights[static_cast<Eigen::Index>(part.vertices.size())] = weight;
      part.vertices.push_back(vertex);
    }
    const double sum = part.weights.sum();
    if (part.vertices.size() < kFewestVertices || !(sum > 0)) continue;
    part.weights /= sum;
    part.area = sum / 6;  // Three corners each, of twice the area.
    parts.push_back(std::move(part));
  }
  return parts;
}

/// Of a part's triangles; the least first.
struct Revolution {
  Eigen::Vector3d axis;
  double along, across;  ///< Variances of normals.
};

Revolution revolution(const Positions& positions, const Triangles& triangles) {
  const auto spread = normal_spread(positions, triangles);
  return {spread.eigenvectors().col(0), spread.eigenvalues()[0], spread.eigenvalues()[1]};
}

std::optional<RoundPart> round_part(const Positions& rest, const Positions& edit, const Triangles& triangles,
                                    const Part& part) {
  const Triangles own = triangles(part.triangles, Eigen::all);
  const Revolution at_rest = revolution(rest, own);
  if (at_rest.across < kSomeSpread) return std::nullopt;
  RoundPart round;
  round.is_sphere = at_rest.along > kNoSpread;
  const auto fit = [&](const Positions& positions, const Eigen::Vector3d& axis) {
    const Positions points = centred(positions(part.vertices, Eigen::all));
    return round.is_sphere ? fit_sphere(points, part.weights) : fit_revolution(points, axis, part.weights);
  };
  const Fit before = fit(rest, at_rest.axis);
  if (!(before.largest < kRound)) return std::nullopt;
  round.first_triangle = static_cast<int>(part.triangles.front());
  round.triangles = static_cast<int>(part.triangles.size());
  round.area = part.area;
  round.radius = before.radius;
  round.before = before.deviation;
  round.after = fit(edit, revolution(edit, own).axis).deviation;
  return round;
}

}  // namespace

std::vector<RoundPart> round_parts(const Positions& rest, const Positions& edit, const Triangles& triangles,
                                   double crease_angle) {
  std::vector<RoundPart> found;
  for (const Part& part : parts_of(rest, triangles, cut_at_creases(rest, triangles, crease_angle))) {
    if (std::optional<RoundPart> round = round_part(rest, edit, triangles, part)) found.push_back(*round);
  }
  std::sort(found.begin(), found.end(),
            [](const RoundPart& a, const RoundPart& b) { return a.first_triangle < b.first_triangle; });
  return found;
}

}  // namespace swage
