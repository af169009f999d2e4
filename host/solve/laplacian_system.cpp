#include "laplacian_system.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "block_system.h"

namespace swage {
namespace {

using Eigen::Index;
using Triplets = std::vector<Eigen::Triplet<double>>;
using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

template <typename Entries>
std::size_t bytes_of(const Entries& matrix) {
  return static_cast<std::size_t>(matrix.nonZeros()) * (sizeof(double) + sizeof(int));
}

SparseMatrix with_soft(const SparseMatrix& laplacian, const std::vector<SoftPoint>& soft) {
  if (soft.empty()) return laplacian;
  Triplets entries;
  for (const SoftPoint& point : soft) {
    for (size_t a = 0; a < 3; ++a) {
      for (size_t b = 0; b < 3; ++b) {
        const double factor = point.factors[static_cast<Index>(a)] * point.factors[static_cast<Index>(b)];
        if (factor != 0) entries.emplace_back(point.vertices[a], point.vertices[b], factor * point.weight);
      }
    }
  }
  SparseMatrix added(laplacian.rows(), laplacian.cols());
  added.setFromTriplets(entries.begin(), entries.end());
  return laplacian + added;
}

SparseMatrix laplacian_of(const PairsRest& pairs) {
  const Index count = pairs.vertices.rows();
  Triplets entries;
  entries.reserve(static_cast<size_t>(2 * pairs.pairs.rows() + count));
  Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(count);
  for (Index p = 0; p < pairs.pairs.rows(); ++p) {
    const int i = pairs.pairs(p, 0), j = pairs.pairs(p, 1);
    const double w = pairs.weights[p];
    diagonal[i] += w;
    diagonal[j] += w;
    entries.emplace_back(i, j, -w);
    entries.emplace_back(j, i, -w);
  }
  for (int v = 0; v < count; ++v) entries.emplace_back(v, v, diagonal[v] == 0 ? 1 : diagonal[v]);
  SparseMatrix laplacian(count, count);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  return laplacian;
}

}  // namespace

LaplacianSystem::LaplacianSystem(const PairsRest& pairs)
    : laplacian_(laplacian_of(pairs)),
      element_count_(static_cast<Index>(pairs.offsets.size()) - 1),
      rest_(pairs.vertices) {
  const std::vector<EndPull> all = pulls(pairs);
  offsets_.assign(static_cast<size_t>(rest_.rows()) + 1, 0);
  for (const auto& [vertex, pull] : all) ++offsets_[static_cast<size_t>(vertex) + 1];
  for (size_t v = 1; v < offsets_.size(); ++v) offsets_[v] += offsets_[v - 1];
  pulls_.resize(all.size());
  std::vector<int> next(offsets_.begin(), offsets_.end() - 1);
  for (const auto& [vertex, pull] : all) pulls_[static_cast<size_t>(next[static_cast<size_t>(vertex)]++)] = pull;
}

std::vector<LaplacianSystem::EndPull> LaplacianSystem::pulls(const PairsRest& pairs) {
  std::vector<EndPull> all;
  std::vector<int> at(static_cast<size_t>(pairs.vertices.rows()), -1);  // Of each vertex its last one in `all`.
  for (int n = 0; n + 1 < static_cast<int>(pairs.offsets.size()); ++n) {
    const auto first = static_cast<int>(all.size());
    const auto add = [&](int v, const Eigen::Vector3d& edge) {
      int& own = at[static_cast<size_t>(v)];
      if (own < first) {
        own = static_cast<int>(all.size());
        all.push_back({v, {n, Eigen::Vector3d::Zero()}});
      }
      all[static_cast<size_t>(own)].second.edges += edge;
    };
    for (int p = pairs.offsets[static_cast<size_t>(n)]; p < pairs.offsets[static_cast<size_t>(n) + 1]; ++p) {
      const int i = pairs.pairs(p, 0), j = pairs.pairs(p, 1);
      const Eigen::Vector3d edge = pairs.weights[p] * (pairs.vertices.row(j) - pairs.vertices.row(i)).transpose();
      add(j, edge);
      add(i, -edge);
    }
  }
  return all;
}

Positions LaplacianSystem::right_hand_sides(const Transforms& matrices) const {
  Positions result(rest_.rows(), 3);
#pragma omp parallel for schedule(static)
  for (Index v = 0; v < result.rows(); ++v) {
    const auto at = static_cast<size_t>(v);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    if (offsets_[at] == offsets_[at + 1]) sum = rest_.row(v);
    for (int i = offsets_[at]; i < offsets_[at + 1]; ++i) {
      const Pull& pull = pulls_[static_cast<size_t>(i)];
      sum += Eigen::Map<const Matrix>(matrices.row(pull.element).data()) * pull.edges;
    }
    result.row(v) = sum;
  }
  return result;
}

std::size_t LaplacianSystem::bytes() const {
  return bytes_of(laplacian_) + pulls_.size() * sizeof(Pull) + offsets_.size() * sizeof(int);
}

HeldLaplacian::HeldLaplacian(const LaplacianSystem& system, const HeldPoints& points)
    : fixed_(points.fixed), soft_(points.soft) {
  const SparseMatrix matrix = with_soft(system.laplacian(), soft_);
  place_free(matrix);
  couple(matrix);
  if (free_.empty()) return;
  const SparseMatrix among = among_free(matrix);
  factor_ = has_cholmod() ? supernodal_factor() : simplicial_factor();
  factor_->analyze(among);
  const int first_bad = factor_->factorize(among);
  if (first_bad >= 0) throw Indefinite(among.rows(), free_[static_cast<size_t>(first_bad)]);
  panels_ = panels_of<AxisPanels>(*factor_);
  if (panels_) factor_.reset();
}

void HeldLaplacian::place_free(const SparseMatrix& matrix) {
  place_.assign(static_cast<size_t>(matrix.rows()), 0);
  for (size_t i = 0; i < fixed_.size(); ++i) place_[static_cast<size_t>(fixed_[i])] = -1 - static_cast<int>(i);
  std::vector<int> free;
  for (int v = 0; v < matrix.rows(); ++v) {
    if (place_[static_cast<size_t>(v)] < 0) continue;
    place_[static_cast<size_t>(v)] = static_cast<int>(free.size());
    free.push_back(v);
  }
  free_ = free;
  if (free.empty()) return;
  const std::vector<int> order = elimination_order(among_free(matrix));
  for (size_t i = 0; i < order.size(); ++i) {
    free_[i] = free[static_cast<size_t>(order[i])];
    place_[static_cast<size_t>(free_[i])] = static_cast<int>(i);
  }
}

SparseMatrix HeldLaplacian::among_free(const SparseMatrix& matrix) const {
  Triplets entries;
  entries.reserve(static_cast<size_t>(matrix.nonZeros()));
  for (const int v : free_) {
    const int column = place_[static_cast<size_t>(v)];
    for (SparseMatrix::InnerIterator entry(matrix, v); entry; ++entry) {
      const int row = place_[static_cast<size_t>(entry.row())];
      if (row >= 0 && row <= column) entries.emplace_back(row, column, entry.value());
    }
  }
  const auto count = static_cast<Index>(free_.size());
  SparseMatrix upper(count, count);
  upper.setFromTriplets(entries.begin(), entries.end());
  return upper;
}

void HeldLaplacian::couple(const SparseMatrix& matrix) {
  Triplets entries;
  for (size_t i = 0; i < fixed_.size(); ++i) {
    for (SparseMatrix::InnerIterator entry(matrix, fixed_[i]); entry; ++entry) {
      const int row = place_[static_cast<size_t>(entry.row())];
      if (row >= 0) entries.emplace_back(row, static_cast<int>(i), entry.value());
    }
  }
  coupling_.resize(static_cast<Index>(free_.size()), static_cast<Index>(fixed_.size()));
  coupling_.setFromTriplets(entries.begin(), entries.end());
}

Positions HeldLaplacian::solve(const Positions& right_hand_sides, const HeldPoints& points) const {
  Positions all = right_hand_sides;
  for (size_t i = 0; i < soft_.size(); ++i) {
    const SoftPoint& point = soft_[i];
    for (size_t k = 0; k < 3; ++k) {
      all.row(point.vertices[k]) +=
          point.factors[static_cast<Index>(k)] * point.weight * points.soft_targets.row(static_cast<Index>(i));
    }
  }
  all(fixed_, Eigen::all) = points.fixed_targets;
  if (free_.empty()) return all;
  Positions free = all(free_, Eigen::all);
  free -= coupling_ * points.fixed_targets;
  if (panels_) {
    panels_->solve(free);
  } else {
    Eigen::MatrixXd columns = free;
    factor_->solve(columns);
    free = columns;
  }
  all(free_, Eigen::all) = free;
  return all;
}

std::size_t HeldLaplacian::coupling_bytes() const { return bytes_of(coupling_); }

std::size_t HeldLaplacian::factor_bytes() const {
  if (panels_) return panels_->bytes();
  return factor_ ? static_cast<std::size_t>(factor_->entries()) * sizeof(double) : 0;
}

std::shared_ptr<const HeldLaplacian> LastHeld::get(const LaplacianSystem& system, const HeldPoints& points) {
  const std::lock_guard lock(mutex_);
  if (!last_ || !last_->holds(points)) last_ = std::make_shared<HeldLaplacian>(system, points);
  return last_;
}

}  // namespace swage
