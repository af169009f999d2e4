#include "thin_triangles.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace swage {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::RowVector3d;
using Eigen::Vector3d;

constexpr double kThin = std::numbers::pi * 10 / 180;  // Radians: triangles of smaller angles are relaxed.
constexpr double kMostTurn = 0.5;                      // Cosine of 60 degrees.
constexpr int kHalvings = 6;                           // Then vertices are put back where they were.
constexpr int kRounds = 3;
constexpr double kPull = 0.3;  // Of the way to the neighbours' mean.
constexpr double kFree = 1e-9;

double least_angle_of(const Matrix3d& corners) { return corner_angles(corners).minCoeff(); }

double least_angle_of(const StylizePlan& plan, const Positions& positions, Index t) {
  return least_angle_of(Matrix3d(positions(plan.mesh.triangles.row(t), Eigen::all)));
}

std::vector<char> vertices_of(const StylizePlan& plan, const std::vector<char>& is_marked) {
  std::vector<char> vertices(plan.component.size(), 0);
  for (Index t = 0; t < plan.mesh.triangles.rows(); ++t) {
    if (is_marked[static_cast<size_t>(t)] == 0) continue;
    for (const int v : plan.mesh.triangles.row(t)) vertices[static_cast<size_t>(v)] = 1;
  }
  return vertices;
}

/// Least angle around a vertex; below 0 where a triangle turned over since `before`.
double least_around(const StylizePlan& plan, const Positions& before, const Positions& now, int v) {
  double least = std::numbers::pi;
  for (const int t : plan.triangles_around[v]) {
    const auto corners = [&](const Positions& positions) -> Matrix3d {
      return positions(plan.mesh.triangles.row(t), Eigen::all);
    };
    const auto normal = [](const Matrix3d& c) { return (c.row(1) - c.row(0)).cross(c.row(2) - c.row(0)).eval(); };
    if (normal(corners(before)).dot(normal(corners(now))) < 0) return -1;
    least = std::min(least, least_angle_of(corners(now)));
  }
  return least;
}

/// Of a step what no target of the triangles around has a part of.
RowVector3d along_targets(const StylizePlan& plan, const Positions& targets, int v, const RowVector3d& step) {
  Matrix3d sum = Matrix3d::Zero();
  for (const int t : plan.triangles_around[v]) sum += targets.row(t).transpose() * targets.row(t);
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(sum);
  RowVector3d free = RowVector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    const RowVector3d axis = solver.eigenvectors().col(k).transpose();
    if (solver.eigenvalues()[k] < kFree) free += step.dot(axis) * axis;
  }
  return free;
}

RowVector3d to_neighbours(const StylizePlan& plan, const Positions& positions, int v) {
  RowVector3d sum = RowVector3d::Zero();
  int count = 0;
  for (const int t : plan.triangles_around[v]) {
    for (const int other : plan.mesh.triangles.row(t)) {
      if (other == v) continue;
      sum += positions.row(other) - positions.row(v);
      ++count;
    }
  }
  return sum / count;
}

struct Step {
  int vertex;
  RowVector3d place;
  double least;  ///< Angle around it before.
};

/// Towards the neighbours, where that alone makes the least angle larger. `now` is `before`, and is so again.
std::optional<Step> best_step(const StylizePlan& plan, const Positions& targets, const Positions& before, int v,
                              Positions& now) {
  Step step{v, before.row(v), least_around(plan, before, before, v)};
  const RowVector3d whole = along_targets(plan, targets, v, kPull * to_neighbours(plan, before, v));
  for (const double part : {1.0, 0.5, 0.25}) {
    now.row(v) = before.row(v) + part * whole;
    if (least_around(plan, before, now, v) <= step.least) continue;
    step.place = now.row(v);
    now.row(v) = before.row(v);
    return step;
  }
  now.row(v) = before.row(v);
  return std::nullopt;
}

/// All at once, so that no order counts; those that the others spoil go back.
void take(const StylizePlan& plan, const Positions& before, std::vector<Step>& steps, Positions& positions) {
  for (const Step& step : steps) positions.row(step.vertex) = step.place;
  while (true) {
    const auto spoilt = std::partition(steps.begin(), steps.end(), [&](const Step& step) {
      return least_around(plan, before, positions, step.vertex) > step.least;
    });
    if (spoilt == steps.end()) return;
    for (auto step = spoilt; step != steps.end(); ++step) positions.row(step->vertex) = before.row(step->vertex);
    steps.erase(spoilt, steps.end());
  }
}

}  // namespace

void hold_back(const StylizePlan& plan, const std::vector<char>& is_fixed, double least_angle,
               const Positions& rest_normals, const Positions& start, Positions& positions) {
  const Index count = plan.mesh.triangles.rows();
  const Positions before = unit_normals(start, plan.mesh.triangles);
  std::vector<char> is_bad(static_cast<size_t>(count));
  for (int round = 0;; ++round) {
    const Positions now = unit_normals(positions, plan.mesh.triangles);
#pragma omp parallel for schedule(static)
    for (Index t = 0; t < count; ++t) {
      bool bad = (before.row(t).dot(now.row(t)) < kMostTurn && !before.row(t).isZero(0)) ||
                 rest_normals.row(t).dot(now.row(t)) < std::min(0.0, rest_normals.row(t).dot(before.row(t)));
      if (!bad) {
        const double angle = least_angle_of(plan, positions, t);
        bad = angle < least_angle && angle < least_angle_of(plan, start, t);
      }
      is_bad[static_cast<size_t>(t)] = bad ? 1 : 0;
    }
    const std::vector<char> is_drawn = vertices_of(plan, is_bad);
    bool moves = false;
    for (Index v = 0; v < positions.rows(); ++v) {
      const auto at = static_cast<size_t>(v);
      if (is_drawn[at] == 0 || is_fixed[at] != 0 || positions.row(v) == start.row(v)) continue;
      moves = true;
      positions.row(v) = round < kHalvings ? RowVector3d((positions.row(v) + start.row(v)) / 2) : start.row(v);
    }
    if (!moves) return;
  }
}

void relax(const StylizePlan& plan, const std::vector<char>& is_fixed, const Positions& targets, Positions& positions) {
  std::vector<char> is_thin(static_cast<size_t>(plan.mesh.triangles.rows()));
  for (int round = 0; round < kRounds; ++round) {
    for (Index t = 0; t < plan.mesh.triangles.rows(); ++t) {
      is_thin[static_cast<size_t>(t)] = least_angle_of(plan, positions, t) < kThin ? 1 : 0;
    }
    const std::vector<char> is_drawn = vertices_of(plan, is_thin);
    const Positions before = positions;
    std::vector<Step> steps;
    for (int v = 0; v < static_cast<int>(positions.rows()); ++v) {
      if (is_drawn[static_cast<size_t>(v)] == 0 || is_fixed[static_cast<size_t>(v)] != 0) continue;
      if (const std::optional<Step> step = best_step(plan, targets, before, v, positions)) steps.push_back(*step);
    }
    take(plan, before, steps, positions);
  }
}

}  // namespace swage
