// How the map of a smooth surface changes from place to place.
#include <Eigen/Geometry>
#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <numbers>

#include "neighbourhoods.h"
#include "parts.h"
#include "pieces.h"
#include "swage/thrown.h"

namespace swage {
namespace {

constexpr int kRings = 2;
constexpr int kCoefficients = 5;  // Of a quadric through the vertex.
// In larger stretches: the image of the normal is no longer. On a surface that is flat but for rounding, any second
// derivative would be one of the normal's image.
constexpr double kLongestNormal = 10;
constexpr double kSingular = 1e-6;  // Of pivots to the largest: whose neighbours lie on a curve tell no quadric.

/// In units of the neighbours' distance, so that all coefficients are alike. A row for each neighbour: terms of second
/// order, with a root so that no turn of the axes changes a norm, then of first.
Eigen::MatrixXd quadric_terms(const Eigen::MatrixX2d& places) {
  const Eigen::ArrayXd x = places.col(0), y = places.col(1);
  Eigen::MatrixXd terms(places.rows(), kCoefficients);
  terms << x * x / 2, x * y / std::numbers::sqrt2, y * y / 2, x, y;
  return terms;
}

/// NaN where neighbours do not tell.
double loss_at(const CurvatureStep::Rest& around, const Positions& edit, int v) {
  const auto at = static_cast<size_t>(v);
  const int first = around.offsets[at], count = around.offsets[at + 1] - first;
  if (count < kCoefficients) return std::numeric_limits<double>::quiet_NaN();
  const Eigen::Map<const Eigen::VectorXi> neighbours(around.neighbours.data() + first, count);
  const Positions from = around.positions(neighbours, Eigen::all).rowwise() - around.positions.row(v);
  const Positions to = edit(neighbours, Eigen::all).rowwise() - edit.row(v);

  const Eigen::Vector3d normal = around.normals.row(v);
  Eigen::Matrix<double, 3, 2> plane;
  plane.col(0) = normal.unitOrthogonal();
  plane.col(1) = normal.cross(plane.col(0));
  const double reach = from.rowwise().norm().mean();
  const Eigen::MatrixX2d places = from * plane / reach;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> fit(quadric_terms(places));
  fit.setThreshold(kSingular);
  if (fit.rank() < kCoefficients) return std::numeric_limits<double>::quiet_NaN();

  const Eigen::Vector3d heights = fit.solve(from * normal).head<3>() / (reach * reach);
  const Eigen::Matrix<double, kCoefficients, 3> map = fit.solve(to);
  const Eigen::Matrix3d curved = map.topRows<3>() / (reach * reach);
  const double stretch = (map.bottomRows<2>() / reach).jacobiSvd().singularValues()[0];
  Eigen::RowVector3d normal_image = Eigen::RowVector3d::Zero();
  if (!heights.isZero(0)) normal_image = heights.transpose() * curved / heights.squaredNorm();
  const double length = normal_image.norm();
  if (length > kLongestNormal * stretch) normal_image *= kLongestNormal * stretch / length;
  return (curved - heights * normal_image).norm();
}

}  // namespace

Eigen::VectorXd slippage_losses(const Positions& rest, const Positions& edit, const Triangles& triangles,
                                double crease_angle) {
  const Pieces pieces = cut_at_creases(rest, triangles, crease_angle);
  const CurvatureStep::Rest around = neighbourhoods(pieces.mesh, kRings);
  Positions moved(pieces.mesh.positions.rows(), 3);
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) moved.row(pieces.mesh.triangles(t, k)) = edit.row(triangles(t, k));
  }
  const auto count = static_cast<int>(moved.rows());
  Eigen::VectorXd at_vertices(count);
  Thrown thrown;
#pragma omp parallel for schedule(dynamic, 256)
  for (int v = 0; v < count; ++v) thrown.keep([&] { at_vertices[v] = loss_at(around, moved, v); });
  thrown.rethrow();

  Eigen::VectorXd losses(triangles.rows());
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    double sum = 0;
    int told = 0;
    for (int v : pieces.mesh.triangles.row(t)) {
      if (std::isnan(at_vertices[v])) continue;
      sum += at_vertices[v];
      ++told;
    }
    losses[t] = told > 0 ? sum / told : std::numeric_limits<double>::quiet_NaN();
  }
  return losses * box_diagonal(rest);
}

}  // namespace swage
