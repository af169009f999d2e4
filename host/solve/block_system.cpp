#include "block_system.h"

#include <Eigen/OrderingMethods>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "swage/error.h"

namespace swage {

BlockSystem::BlockSystem(int group_count, int rows_per_group, const std::vector<std::pair<int, int>>& couplings)
    : width_(3 * rows_per_group) {
  order(group_count, couplings);
  check_factor();
  lay_out();
}

void BlockSystem::order(int group_count, const std::vector<std::pair<int, int>>& couplings) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(2 * couplings.size() + static_cast<size_t>(group_count));
  for (const auto& [i, j] : couplings) {
    entries.emplace_back(i, j, 1.0);
    entries.emplace_back(j, i, 1.0);
  }
  // The ordering puts a row without its diagonal aside as dense.
  for (int g = 0; g < group_count; ++g) entries.emplace_back(g, g, 1.0);
  Eigen::SparseMatrix<double> graph(group_count, group_count);
  graph.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> elimination;
  Eigen::AMDOrdering<int>()(graph.selfadjointView<Eigen::Lower>(), elimination);

  place_.resize(static_cast<size_t>(group_count));
  for (int p = 0; p < group_count; ++p) place_[static_cast<size_t>(elimination.indices()[p])] = p;
  above_.resize(static_cast<size_t>(group_count));
  for (int g = 0; g < group_count; ++g) {
    const int p = place_[static_cast<size_t>(g)];
    std::vector<int>& above = above_[static_cast<size_t>(p)];
    for (Eigen::SparseMatrix<double>::InnerIterator other(graph, g); other; ++other) {
      const int q = place_[static_cast<size_t>(other.row())];
      if (q < p) above.push_back(q);
    }
    std::sort(above.begin(), above.end());
  }
}

/// The factor's entries are counted in int: beyond, its making would end in the dark.
void BlockSystem::check_factor() const {
  std::vector<int> parent(above_.size(), -1), seen_from(above_.size(), -1);
  std::int64_t blocks = 0;
  for (int p = 0; p < static_cast<int>(above_.size()); ++p) {
    seen_from[static_cast<size_t>(p)] = p;
    ++blocks;
    // The row of p in the factor: all on the way up the elimination tree to p.
    for (int q : above_[static_cast<size_t>(p)]) {
      for (; seen_from[static_cast<size_t>(q)] != p; q = parent[static_cast<size_t>(q)]) {
        if (parent[static_cast<size_t>(q)] == -1) parent[static_cast<size_t>(q)] = p;
        seen_from[static_cast<size_t>(q)] = p;
        ++blocks;
      }
    }
  }
  const std::int64_t entries = blocks * width_ * width_;
  if (entries <= std::numeric_limits<int>::max()) return;
  throw Unsolvable("factor: the matrix of " + std::to_string(above_.size()) + " elements needs up to " +
                   std::to_string(entries) + " entries, " + std::to_string(std::numeric_limits<int>::max()) +
                   " can be held: take a coarser mesh");
}

void BlockSystem::lay_out() {
  const auto unknowns = static_cast<Eigen::Index>(above_.size()) * width_;
  std::vector<int> entries_of_columns;
  for (const std::vector<int>& above : above_) {
    for (int c = 0; c < width_; ++c) entries_of_columns.push_back(3 * static_cast<int>(above.size()) + c + 1);
  }
  matrix_.resize(unknowns, unknowns);
  if (unknowns == 0) return;  // Eigen reads beyond an empty matrix.
  matrix_.reserve(entries_of_columns);
  for (int p = 0; p < static_cast<int>(above_.size()); ++p) {
    for (int c = 0; c < width_; ++c) {
      const int column = p * width_ + c;
      for (const int q : above_[static_cast<size_t>(p)]) {
        for (int r = 0; r < 3; ++r) matrix_.insert(q * width_ + c / 3 * 3 + r, column) = 0;
      }
      for (int r = 0; r <= c; ++r) matrix_.insert(p * width_ + r, column) = 0;
    }
  }
  matrix_.makeCompressed();
}

int BlockSystem::offset(int above, int group) const {
  const std::vector<int>& places = above_[static_cast<size_t>(group)];
  return 3 * static_cast<int>(std::lower_bound(places.begin(), places.end(), above) - places.begin());
}

void BlockSystem::add(int group, const Eigen::Ref<const Eigen::MatrixXd>& block) {
  const int p = place_[static_cast<size_t>(group)];
  const int start = 3 * static_cast<int>(above_[static_cast<size_t>(p)].size());
  for (int c = 0; c < width_; ++c) {
    double* column = matrix_.valuePtr() + matrix_.outerIndexPtr()[p * width_ + c] + start;
    for (int r = 0; r <= c; ++r) column[r] += block(r, c);
  }
}

void BlockSystem::add(int i, int j, int row, const Eigen::Matrix3d& block) {
  const int p = place_[static_cast<size_t>(i)], q = place_[static_cast<size_t>(j)];
  const int start = offset(std::min(p, q), std::max(p, q));
  for (int c = 0; c < 3; ++c) {
    double* column = matrix_.valuePtr() + matrix_.outerIndexPtr()[std::max(p, q) * width_ + 3 * row + c] + start;
    for (int r = 0; r < 3; ++r) column[r] += p < q ? block(r, c) : block(c, r);
  }
}

void BlockSystem::factor() {
  if (!factor_) {
    factor_ = std::make_unique<Factor>();
    factor_->analyzePattern(matrix_);
  }
  factor_->factorize(matrix_);
  // The factorisation stops at a zero pivot only: a negative or undefined one goes on as if nothing were.
  const auto pivots = factor_->vectorD();
  Eigen::Index first = 0;
  while (first < pivots.size() && pivots[first] > 0) ++first;
  if (first == pivots.size() && std::isfinite(pivots.sum())) return;
  const auto group = std::find(place_.begin(), place_.end(), static_cast<int>(first) / width_) - place_.begin();
  throw Unsolvable("factor: the matrix of " + std::to_string(unknowns()) +
                   " unknowns is not positive definite, first seen at element " + std::to_string(group) +
                   "; look there for degenerate triangles or a part without a handle");
}

Eigen::VectorXd BlockSystem::solve(const Eigen::Ref<const Eigen::VectorXd>& right_hand_side) const {
  return as_given(factor_->solve(ordered(right_hand_side)));
}

Eigen::VectorXd BlockSystem::times(const Eigen::Ref<const Eigen::VectorXd>& vector) const {
  return as_given(matrix_.selfadjointView<Eigen::Upper>() * ordered(vector));
}

Eigen::VectorXd BlockSystem::ordered(const Eigen::Ref<const Eigen::VectorXd>& vector) const {
  Eigen::VectorXd result(vector.size());
  for (size_t g = 0; g < place_.size(); ++g) {
    result.segment(place_[g] * width_, width_) = vector.segment(static_cast<Eigen::Index>(g) * width_, width_);
  }
  return result;
}

Eigen::VectorXd BlockSystem::as_given(const Eigen::VectorXd& ordered) const {
  Eigen::VectorXd result(ordered.size());
  for (size_t g = 0; g < place_.size(); ++g) {
    result.segment(static_cast<Eigen::Index>(g) * width_, width_) = ordered.segment(place_[g] * width_, width_);
  }
  return result;
}

}  // namespace swage
