#include "rims.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace swage::test {
namespace {

constexpr double kRound = 1e-9;  // Of the radius.

Eigen::MatrixX2d across(const Positions& positions, const Rim& rim) {
  Eigen::MatrixX2d points(rim.vertices.size(), 2);
  points << positions(rim.vertices, (rim.axis + 1) % 3), positions(rim.vertices, (rim.axis + 2) % 3);
  return points;
}

double distance(const Eigen::RowVector3d& point, const Eigen::RowVector3d& middle, int axis) {
  Eigen::RowVector3d away = point - middle;
  away[axis] = 0;
  return away.norm();
}

}  // namespace

Rim rim_of(const Assembled& model, const Part& part, int axis) {
  const auto points = model.mesh.positions.middleRows(part.first, part.count);
  const Eigen::RowVector3d middle = (points.colwise().minCoeff() + points.colwise().maxCoeff()) / 2;
  double radius = 0;
  for (const auto& point : points.rowwise()) radius = std::max(radius, distance(point, middle, axis));
  Rim rim{{}, axis};
  for (Eigen::Index v = 0; v < part.count; ++v) {
    if (distance(points.row(v), middle, axis) < radius * (1 - kRound)) continue;
    rim.vertices.push_back(static_cast<int>(part.first + v));
  }
  return rim;
}

std::vector<Rim> rims_of(const Assembled& model, const std::string& beginning, int axis) {
  std::vector<Rim> rims;
  for (const Part& part : model.named(beginning)) rims.push_back(rim_of(model, part, axis));
  return rims;
}

std::vector<Rim> bolt_holes(const Assembled& plate) {
  std::vector<Rim> rims;
  for (const double x : {-20.0, 20.0}) {
    for (const double z : {-10.0, 10.0}) {
      Rim& rim = rims.emplace_back(Rim{{}, 1});
      for (int v = 0; v < plate.parts.front().count; ++v) {
        if (std::abs(distance(plate.mesh.positions.row(v), {x, 0, z}, 1) - 3) < 1e-6) rim.vertices.push_back(v);
      }
    }
  }
  return rims;
}

double oval(const Positions& positions, const Rim& rim) {
  // Points spaced evenly around a circle have the same second moments in all directions, and a linear map gives them
  // those of the ellipse.
  Eigen::MatrixX2d points = across(positions, rim);
  points.rowwise() -= points.colwise().mean().eval();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> moments(Eigen::Matrix2d(points.transpose() * points));
  return std::sqrt(moments.eigenvalues()[1] / moments.eigenvalues()[0]) - 1;
}

double most_oval(const Positions& positions, const std::vector<Rim>& rims) {
  double most = 0;
  for (const Rim& rim : rims) most = std::max(most, oval(positions, rim));
  return most;
}

Eigen::RowVector2d diameters(const Positions& positions, const Rim& rim) {
  const Eigen::MatrixX2d points = across(positions, rim);
  return points.colwise().maxCoeff() - points.colwise().minCoeff();
}

}  // namespace swage::test
