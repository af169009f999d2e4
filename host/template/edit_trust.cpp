// Where the template asks for what the mesh cannot do.
#include <algorithm>

#include "edit_plan.h"
#include "matrices.h"

namespace swage {
namespace {

using Eigen::Index;

constexpr double kTrust = 0.1;  // Part of the tracking that is left, each time, around triangles that turned over,
constexpr double kLeastTrust = 1e-3;  // and in the end: what is not held at all drifts away.
constexpr double kOpposed = -0.5;     // Cosine of a gradient and the last pass's there: the template's other side.
constexpr double kTold = 0.3;         // Part that is left, each time, of what is told of both sides by turns.
constexpr int kEveningRounds = 16;    // Of evening maps out.

/// The vertices' maps evened out over some rings, each counting as much as its vertex is trusted.
Transforms evened_maps(const EditPlan& plan) {
  using Sums = Eigen::Matrix<double, Eigen::Dynamic, 10, Eigen::RowMajor>;  // Maps by trust, and trust.
  const SparseMatrix& laplacian = plan.system.laplacian();
  Sums sums(plan.maps.rows(), 10), before;
  sums << plan.trust.asDiagonal() * plan.maps, plan.trust;
  for (int round = 0; round < kEveningRounds; ++round) {
    std::swap(sums, before);
    sums.resizeLike(before);
#pragma omp parallel for schedule(static)
    for (Index v = 0; v < laplacian.cols(); ++v) {
      Eigen::Matrix<double, 1, 10> sum = Eigen::Matrix<double, 1, 10>::Zero();
      for (SparseMatrix::InnerIterator entry(laplacian, v); entry; ++entry) sum += before.row(entry.row());
      sums.row(v) = sum / static_cast<double>(laplacian.col(v).nonZeros());
    }
  }
  return sums.leftCols<9>().array().colwise() / sums.col(9).array();
}

/// The rest area vectors of `triangles` as their corners' maps take them.
Positions carried_areas(const EditPlan& plan, const Triangles& triangles, const Transforms& vertex_maps) {
  Positions areas = area_vectors(plan.elements.pairs.vertices, triangles);
  const Transforms maps = matrices_of_triangles(plan.elements, triangles, vertex_maps);
  for (Index t = 0; t < areas.rows(); ++t) {
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> map(maps.row(t).data());
    Eigen::Matrix3d cofactors;
    cofactors << map.row(1).cross(map.row(2)), map.row(2).cross(map.row(0)), map.row(0).cross(map.row(1));
    areas.row(t) = areas.row(t) * cofactors.transpose();
  }
  return areas;
}

/// Of `triangles` those that now face against `before`, but those flat at rest.
std::vector<int> against(const EditPlan& plan, const Triangles& triangles, const std::vector<char>& is_flat,
                         const Positions& before) {
  const Positions after = area_vectors(plan.positions, triangles);
  std::vector<int> found;
  for (Index t = 0; t < after.rows(); ++t) {
    if (is_flat[static_cast<size_t>(t)] == 0 && before.row(t).dot(after.row(t)) < 0)
      found.push_back(static_cast<int>(t));
  }
  return found;
}

}  // namespace

std::vector<int> folded(const EditPlan& plan) {
  const Triangles& triangles = plan.mesh.triangles;
  return against(plan, triangles, plan.is_flat, carried_areas(plan, triangles, plan.maps));
}

Positions faced(const EditPlan& plan, const Triangles& triangles) {
  Positions rest = area_vectors(plan.elements.pairs.vertices, triangles);
  const Positions carried = carried_areas(plan, triangles, evened_maps(plan));
  for (Index t = 0; t < rest.rows(); ++t) {
    if (rest.row(t).dot(carried.row(t)) < 0) rest.row(t) = carried.row(t);
  }
  return rest;
}

std::vector<int> flipped(const EditPlan& plan, const Triangles& triangles, const std::vector<char>& is_flat) {
  return against(plan, triangles, is_flat, faced(plan, triangles));
}

std::vector<char> around(const EditPlan& plan, const std::vector<int>& triangles, int rings) {
  std::vector<char> reached(static_cast<size_t>(plan.trust.size()), 0);
  for (const int t : triangles) {
    for (const int v : plan.mesh.triangles.row(t)) reached[static_cast<size_t>(v)] = 1;
  }
  for (int ring = 0; ring < rings; ++ring) {
    const std::vector<char> before = reached;
    for (const auto& edge : plan.edges.vertices.rowwise()) {
      const auto a = static_cast<size_t>(edge[0]), b = static_cast<size_t>(edge[1]);
      if (before[a] != 0) reached[b] = 1;
      if (before[b] != 0) reached[a] = 1;
    }
  }
  return reached;
}

void distrust(EditPlan& plan, const std::vector<int>& triangles, int rings) {
  const std::vector<char> reached = around(plan, triangles, rings);
  for (Index v = 0; v < plan.trust.size(); ++v) {
    if (reached[static_cast<size_t>(v)] != 0) plan.trust[v] = std::max(kLeastTrust, kTrust * plan.trust[v]);
  }
}

void let_go(EditPlan& plan, const std::vector<char>& inside) {
  for (Index v = 0; v < plan.trust.size(); ++v) {
    if (inside[static_cast<size_t>(v)] != 0) plan.trust[v] = std::min(kLeastTrust, plan.trust[v]);
  }
}

void distrust_opposed(EditPlan& plan, const Positions& gradients) {
  for (Index v = 0; v < plan.trust.size(); ++v) {
    if (gradients.row(v).dot(plan.tracking.gradients.row(v)) < kOpposed)
      plan.trust[v] = std::max(kLeastTrust, kTold * plan.trust[v]);
  }
}

}  // namespace swage
