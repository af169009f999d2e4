#include "collapses.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace swage {
namespace {

// How far a normal may turn from the original's: 45 degrees.
constexpr double kLeastCosine = 0.7071;
// Two triangles fold where their normals are this opposite: a wedge of 18 degrees.
constexpr double kFold = -0.95;
// A wedge as sharp as one that is there already, up to rounding in the normals.
constexpr double kFoldRounding = 1e-3;
// Height over longest side, at most sqrt(3/4): refused below the one unless the original is worse, dearer below the
// other, its own normal not trusted below the last.
constexpr double kSlim = 0.02, kWellShaped = 0.6, kNoNormal = 1e-3;
// Cost of moving a vertex by its distance within the surface, against that distance off it. Evens the sizes of
// triangles out where the surface bends by less than a few degrees a triangle.
constexpr double kAlong = 2e-3;
// A vertex of more sides stays until it has fewer, and of those it has only so many are tried: what lies around a
// vertex is looked at whenever something there changes.
constexpr size_t kMostSides = 64, kTries = 12;
constexpr double kRefused = std::numeric_limits<double>::infinity();

double longest_squared(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
}

Eigen::Vector3d direction(const Eigen::Vector3d& vector) {
  const double length = vector.norm();
  return length > 0 ? Eigen::Vector3d(vector / length) : Eigen::Vector3d::Zero();
}

}  // namespace

bool Collapses::prepare(Pace& pace) { return scale(pace) && measure(pace) && refer(pace); }

bool Collapses::scale(Pace& pace) {
  const Eigen::RowVector3d low = positions_.colwise().minCoeff(), high = positions_.colwise().maxCoeff();
  const double extent = (high - low).maxCoeff();
  points_ = (positions_.rowwise() - (low + high) / 2) / (extent > 0 ? extent : 1);
  return pace.step(0);
}

bool Collapses::measure(Pace& pace) {
  const Triangles& triangles = surface_.triangles();
  quadrics_.setZero(points_.rows(), 10);
  normals_.resize(triangles.rows(), 3);
  for (int t = 0; t < triangles.rows(); ++t) {
    if (!pace.step(0)) return false;
    const Eigen::Vector3d area = area_vector(t);
    const Eigen::Vector3d n = direction(area);
    const double d = -n.dot(point(triangles(t, 0)));
    Eigen::Matrix<double, 1, 10> quadric;
    quadric << n.x() * n.x(), n.y() * n.y(), n.z() * n.z(), 2 * n.x() * n.y(), 2 * n.y() * n.z(), 2 * n.z() * n.x(),
        2 * d * n.x(), 2 * d * n.y(), 2 * d * n.z(), d * d;
    for (int k = 0; k < 3; ++k) quadrics_.row(triangles(t, k)) += area.norm() * quadric;
    normals_.row(t) = n.cast<float>();
  }
  return true;
}

/// A sliver's normal may be anything: the one to be faithful to is its neighbourhood's.
bool Collapses::refer(Pace& pace) {
  const Triangles& triangles = surface_.triangles();
  references_ = normals_;
  for (int t = 0; t < triangles.rows(); ++t) {
    if (!pace.step(0)) return false;
    Eigen::Vector3d area = area_vector(t);
    const double longest = longest_squared(point(triangles(t, 0)), point(triangles(t, 1)), point(triangles(t, 2)));
    if (area.norm() > kNoNormal * longest) continue;
    for (int side = 3 * t; side < 3 * t + 3; ++side) {
      if (surface_.twin(side) >= 0) area += area_vector(surface_.twin(side) / 3);
    }
    references_.row(t) = direction(area).cast<float>();
  }
  return true;
}

Eigen::Vector3d Collapses::area_vector(int triangle) const {
  const auto corners = surface_.triangles().row(triangle);
  const Eigen::Vector3d a = point(corners[0]);
  return (point(corners[1]) - a).cross(point(corners[2]) - a);
}

/// Squared distances to the planes that the vertex stands for, weighted by twice their areas.
double Collapses::flatness(int vertex, const Eigen::Vector3d& at) const {
  const auto q = quadrics_.row(vertex);
  const double x = at.x(), y = at.y(), z = at.z();
  return std::max(0.0, x * (q[0] * x + q[3] * y + q[6]) + y * (q[1] * y + q[4] * z + q[7]) +
                           z * (q[2] * z + q[5] * x + q[8]) + q[9]);
}

/// False where there are too many spokes.
bool Collapses::spread(int vertex) {
  spokes_.clear();
  const int first = surface_.first(vertex);
  int spoke = first;
  do {
    spokes_.push_back(spoke);
    spoke = surface_.turned(spoke);
  } while (spoke != first && spokes_.size() <= kMostSides);
  return spoke == first;
}

Choice Collapses::cheapest(int vertex) {
  Choice choice;
  if (surface_.is_locked(vertex) || !spread(vertex)) return choice;
  const Eigen::Vector3d at = point(vertex);
  const double weight = kAlong * quadrics_.row(vertex).head<3>().sum();
  auto along = [&](size_t i) { return weight * (point(surface_.to(spokes_[i])) - at).squaredNorm(); };
  candidates_.clear();
  for (size_t i = 0; i < spokes_.size(); ++i) {
    candidates_.emplace_back(flatness(vertex, point(surface_.to(spokes_[i]))) + along(i), i);
  }
  std::sort(candidates_.begin(), candidates_.end());
  if (candidates_.size() > kTries) candidates_.resize(kTries);
  for (const auto& [least, i] : candidates_) {
    if (least >= choice.cost) break;
    const double cost = least + along(i) * harm(i);
    if (cost < choice.cost && surface_.may_collapse(spokes_[i]) && !folds(i)) choice = {cost, spokes_[i]};
  }
  return choice;
}

/// Of a collapse along a spoke: by how much the worst triangle's shape makes it dearer, 0 where all are well shaped.
/// Leaves the new normals.
double Collapses::harm(size_t target) {
  const size_t count = spokes_.size();
  const Eigen::Vector3d at = point(surface_.to(spokes_[target]));
  double worst = 1;
  turned_.clear();
  for (size_t i = 1; i + 1 < count; ++i) {
    const int spoke = spokes_[(target + i) % count];
    const Eigen::Vector3d p = point(surface_.to(spoke)), q = point(surface_.from(HalfEdges::previous(spoke)));
    const Eigen::Vector3d area = (p - at).cross(q - at);
    const double size = area.norm();
    if (!(area.dot(references_.row(spoke / 3).cast<double>()) > kLeastCosine * size)) return kRefused;
    worst = std::min(worst, size / longest_squared(at, p, q));
    turned_.emplace_back(area / size);
  }
  if (worst < kSlim && worst < slimmest()) return kRefused;
  return std::max(0.0, kWellShaped / worst - 1);
}

double Collapses::slimmest() const {
  double worst = 1;
  for (int spoke : spokes_) {
    const auto corners = surface_.triangles().row(spoke / 3);
    worst = std::min(worst, area_vector(spoke / 3).norm() /
                                longest_squared(point(corners[0]), point(corners[1]), point(corners[2])));
  }
  return worst;
}

/// Zero where the surface ends.
Eigen::Vector3d Collapses::normal_across(int side) const {
  const int twin = surface_.twin(side);
  return twin < 0 ? Eigen::Vector3d::Zero() : Eigen::Vector3d(normals_.row(twin / 3).cast<double>());
}

/// Whether a collapse along a spoke makes a wedge sharper than any there. Takes the normals that `harm` left.
bool Collapses::folds(size_t target) const {
  const size_t count = spokes_.size();
  const int first = spokes_[target], last = surface_.twin(first);
  Eigen::Vector3d before = normal_across(HalfEdges::next(first));
  double least = 1;
  for (size_t i = 1; i + 1 < count; ++i) {
    const Eigen::Vector3d& n = turned_[i - 1];
    const int outer = HalfEdges::next(spokes_[(target + i) % count]);
    least = std::min({least, n.dot(before), n.dot(normal_across(outer))});
    before = n;
  }
  least = std::min(least, before.dot(normal_across(HalfEdges::previous(last))));
  return least < kFold && least < sharpest() - kFoldRounding;
}

double Collapses::sharpest() const {
  double least = 1;
  for (int spoke : spokes_) {
    const Eigen::Vector3d n = normals_.row(spoke / 3).cast<double>();
    least = std::min({least, n.dot(normal_across(spoke)), n.dot(normal_across(HalfEdges::next(spoke)))});
  }
  return least;
}

void Collapses::collapse(int side) {
  const int from = surface_.from(side), to = surface_.to(side);
  spread(from);
  surface_.collapse(side);
  quadrics_.row(to) += quadrics_.row(from);
  for (int spoke : spokes_) {
    if (!surface_.is_gone(spoke / 3)) normals_.row(spoke / 3) = direction(area_vector(spoke / 3)).cast<float>();
  }
}

int Collapses::likest(int triangle, const std::array<int, 2>& others) const {
  const auto n = normals_.row(triangle);
  const float first = n.dot(normals_.row(others[0])), second = n.dot(normals_.row(others[1]));
  return first > second || (first == second && others[0] < others[1]) ? others[0] : others[1];
}

}  // namespace swage
