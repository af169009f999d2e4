// The vertices for the matrices: a sparse system, the same for x, y and z.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "plan.h"
#include "swage/error.h"

namespace swage {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

// In mean diagonal entries: of a point within a triangle, which is held no other way.
constexpr double kFirm = 1e6;

bool is_fixed(const DeformOptions& options, const Hold& hold) { return !options.handle_weight && hold.factors[0] == 1; }

/// Nothing is joined to it: it stays where it is.
bool is_alone(const DeformPlan& plan, Eigen::Index v) {
  const int* rows = plan.system.turned_edges.outerIndexPtr();
  return rows[v] == rows[v + 1];
}

double weight_of(const DeformPlan& plan, const Hold& hold) {
  if (plan.options.handle_weight) return hold.share * *plan.options.handle_weight;
  return hold.share * kFirm * plan.system.laplacian.diagonal().mean();
}

void add_held(const DeformPlan& plan, const Hold& hold, Triplets& entries) {
  for (size_t a = 0; a < 3; ++a) {
    for (size_t b = 0; b < 3; ++b) {
      const double factor = hold.factors[static_cast<Eigen::Index>(a)] * hold.factors[static_cast<Eigen::Index>(b)];
      if (factor != 0) entries.emplace_back(hold.vertices[a], hold.vertices[b], factor * weight_of(plan, hold));
    }
  }
}

SparseMatrix laplacian_with(const DeformPlan& plan, const std::vector<Hold>& holds) {
  Triplets entries;
  for (const Hold& hold : holds) {
    if (!is_fixed(plan.options, hold)) add_held(plan, hold, entries);
  }
  SparseMatrix held(plan.system.laplacian.rows(), plan.system.laplacian.cols());
  held.setFromTriplets(entries.begin(), entries.end());
  return plan.system.laplacian + held;
}

void split(const SparseMatrix& laplacian, HeldSystem& held) {
  std::vector<int> place(static_cast<size_t>(laplacian.rows()), -1);
  for (const int v : held.fixed) place[static_cast<size_t>(v)] = 0;
  for (int v = 0; v < laplacian.rows(); ++v) {
    if (place[static_cast<size_t>(v)] < 0) held.free.push_back(v);
  }
  const auto number = [&](const std::vector<int>& vertices) {
    for (size_t i = 0; i < vertices.size(); ++i) place[static_cast<size_t>(vertices[i])] = static_cast<int>(i);
  };
  number(held.fixed);
  number(held.free);
  std::vector<char> is_free(place.size(), 0);
  for (const int v : held.free) is_free[static_cast<size_t>(v)] = 1;
  Triplets among, across;
  for (const int column : held.free) {
    for (SparseMatrix::InnerIterator entry(laplacian, column); entry; ++entry) {
      const auto row = static_cast<size_t>(entry.row());
      const int at = place[static_cast<size_t>(column)];
      if (is_free[row] != 0) {
        among.emplace_back(place[row], at, entry.value());
      } else {
        across.emplace_back(at, place[row], entry.value());
      }
    }
  }
  const auto free = static_cast<Eigen::Index>(held.free.size()), fixed = static_cast<Eigen::Index>(held.fixed.size());
  SparseMatrix matrix(free, free);
  matrix.setFromTriplets(among.begin(), among.end());
  held.coupling.resize(free, fixed);
  held.coupling.setFromTriplets(across.begin(), across.end());
  if (free > 0) held.factor.compute(matrix);
}

[[noreturn]] void refuse(const DeformPlan& plan, int vertex) {
  const bool is_given = vertex < plan.mesh.positions.rows();
  const int told = is_given && plan.given ? plan.given->vertex(vertex) : vertex;
  throw Unsolvable("Deform: the system is singular near vertex " + std::to_string(told) +
                   ": its triangles are too badly shaped, or nothing holds them; remesh, or add a handle there");
}

void check_factor(const DeformPlan& plan, const HeldSystem& held) {
  if (held.free.empty()) return;
  const Eigen::VectorXd pivots = held.factor.vectorD();
  if (pivots.allFinite() && pivots.minCoeff() > 0) return;
  Eigen::Index first = 0;
  while (pivots[first] > 0 && std::isfinite(pivots[first])) ++first;
  refuse(plan, held.free[static_cast<size_t>(held.factor.permutationPinv().indices()[first])]);
}

std::shared_ptr<const HeldSystem> factored(const DeformPlan& plan, const std::vector<Hold>& holds,
                                           std::vector<std::array<int, 3>> key) {
  auto held = std::make_shared<HeldSystem>();
  held->key = std::move(key);
  for (const Hold& hold : holds) {
    if (is_fixed(plan.options, hold)) held->fixed.push_back(hold.vertices[0]);
  }
  std::sort(held->fixed.begin(), held->fixed.end());
  held->fixed.erase(std::unique(held->fixed.begin(), held->fixed.end()), held->fixed.end());
  split(laplacian_with(plan, holds), *held);
  check_factor(plan, *held);
  return held;
}

/// Of handles at one place, which are one vertex, the mean.
Positions fixed_targets(const DeformOptions& options, const HeldSystem& held, const std::vector<Hold>& holds) {
  Positions sums = Positions::Zero(static_cast<Eigen::Index>(held.fixed.size()), 3);
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(sums.rows());
  for (const Hold& hold : holds) {
    if (!is_fixed(options, hold)) continue;
    const auto at = std::lower_bound(held.fixed.begin(), held.fixed.end(), hold.vertices[0]) - held.fixed.begin();
    sums.row(at) += hold.target;
    counts[at] += 1;
  }
  return counts.cwiseInverse().asDiagonal() * sums;
}

Positions right_hand_side(const DeformPlan& plan, const std::vector<Hold>& holds, const Transforms& matrices) {
  // Row 3 n + k of the turned edges' factor is column k of matrix n.
  Positions columns(3 * matrices.rows(), 3);
  for (Eigen::Index n = 0; n < matrices.rows(); ++n) {
    for (int r = 0; r < 3; ++r) {
      for (int k = 0; k < 3; ++k) columns(3 * n + k, r) = matrices(n, 3 * r + k);
    }
  }
  const auto& edges = plan.system.turned_edges;
  Positions result(edges.rows(), 3);
#pragma omp parallel for schedule(static)
  for (Eigen::Index v = 0; v < edges.rows(); ++v) {
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator entry(edges, v); entry; ++entry) {
      sum += entry.value() * columns.row(entry.col());
    }
    result.row(v) = is_alone(plan, v) ? plan.elements.pairs.vertices.row(v) : sum;
  }
  for (const Hold& hold : holds) {
    if (is_fixed(plan.options, hold)) continue;
    for (size_t a = 0; a < 3; ++a) {
      result.row(hold.vertices[a]) += hold.factors[static_cast<Eigen::Index>(a)] * weight_of(plan, hold) * hold.target;
    }
  }
  return result;
}

}  // namespace

GlobalSystem global_system(const PairsRest& pairs) {
  const Eigen::Index vertices = pairs.vertices.rows(), elements = static_cast<Eigen::Index>(pairs.offsets.size()) - 1;
  Triplets laplacian, edges;
  Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(vertices);
  for (Eigen::Index n = 0; n < elements; ++n) {
    for (int p = pairs.offsets[static_cast<size_t>(n)]; p < pairs.offsets[static_cast<size_t>(n) + 1]; ++p) {
      const int i = pairs.pairs(p, 0), j = pairs.pairs(p, 1);
      const double w = pairs.weights[p];
      diagonal[i] += w;
      diagonal[j] += w;
      laplacian.emplace_back(i, j, -w);
      laplacian.emplace_back(j, i, -w);
      for (int k = 0; k < 3; ++k) {
        const double part = w * (pairs.vertices(j, k) - pairs.vertices(i, k));
        edges.emplace_back(j, static_cast<int>(3 * n + k), part);
        edges.emplace_back(i, static_cast<int>(3 * n + k), -part);
      }
    }
  }
  for (int v = 0; v < vertices; ++v) laplacian.emplace_back(v, v, diagonal[v] == 0 ? 1 : diagonal[v]);
  GlobalSystem system{SparseMatrix(vertices, vertices), {vertices, 3 * elements}};
  system.laplacian.setFromTriplets(laplacian.begin(), laplacian.end());
  system.turned_edges.setFromTriplets(edges.begin(), edges.end());
  return system;
}

std::shared_ptr<const HeldSystem> held_system(DeformPlan& plan, const std::vector<Hold>& holds) {
  std::vector<std::array<int, 3>> key;
  key.reserve(holds.size());
  for (const Hold& hold : holds) key.push_back(hold.vertices);
  const std::lock_guard lock(plan.holding);
  if (!plan.held || plan.held->key != key) plan.held = factored(plan, holds, std::move(key));
  return plan.held;
}

Positions place_vertices(const DeformPlan& plan, const HeldSystem& held, const std::vector<Hold>& holds,
                         const Transforms& matrices) {
  const Positions targets = fixed_targets(plan.options, held, holds), all = right_hand_side(plan, holds, matrices);
  Positions placed(all.rows(), 3);
  placed(held.fixed, Eigen::all) = targets;
  if (held.free.empty()) return placed;
  const Eigen::MatrixX3d right = all(held.free, Eigen::all) - held.coupling * targets;
  Eigen::MatrixX3d free(right.rows(), 3);
#pragma omp parallel for schedule(static)
  for (int axis = 0; axis < 3; ++axis) free.col(axis) = held.factor.solve(right.col(axis));
  placed(held.free, Eigen::all) = free;
  return placed;
}

}  // namespace swage
