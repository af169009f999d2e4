#include "block_system.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>

#include "conjugate_gradients.h"
#include "swage/error.h"

namespace swage {
namespace {

constexpr Eigen::Index kGroupsWorthThreads = 20000;  // Groups.
constexpr double kWorstError = 0.1;                  // Of a solve in single precision.
constexpr double kNear = 1e-5;
constexpr int kIterationsOfAFactor = 12;  // That take as long: 10 to 15 on vertex steps of 4,000 to 84,000 triangles.

}  // namespace

Indefinite::Indefinite(Eigen::Index unknowns, int element)
    : Unsolvable("factor: the matrix of " + std::to_string(unknowns) +
                 " unknowns is not positive definite, first seen at element " + std::to_string(element) +
                 "; look there for degenerate triangles or a part without a handle"),
      unknowns_(unknowns),
      element_(element) {}

BlockSystem::BlockSystem(int group_count, int rows_per_group, const std::vector<std::pair<int, int>>& couplings,
                         std::optional<FactorKind> kind)
    : BlockSystem(3 * rows_per_group, pattern(group_count, 3 * rows_per_group, couplings, kind)) {
  lay_out();
}

BlockSystem::BlockSystem(int width, std::shared_ptr<const Pattern> pattern)
    : width_(width), pattern_(std::move(pattern)) {
  if (pattern_->kind == FactorKind::simplicial) factor_ = simplicial_factor();
  if (pattern_->kind == FactorKind::supernodal) factor_ = supernodal_factor();
}

BlockSystem BlockSystem::unfactored() const {
  BlockSystem other(width_, pattern_);
  other.matrix_ = matrix_;
  return other;
}

void BlockSystem::lay_out() {
  const auto unknowns = static_cast<Eigen::Index>(pattern_->above.size()) * width_;
  std::vector<int> entries_of_columns;
  for (const std::vector<int>& above : pattern_->above) {
    for (int c = 0; c < width_; ++c) entries_of_columns.push_back(3 * static_cast<int>(above.size()) + c + 1);
  }
  matrix_.resize(unknowns, unknowns);
  if (unknowns == 0) return;  // Eigen reads beyond an empty matrix.
  matrix_.reserve(entries_of_columns);
  for (int p = 0; p < static_cast<int>(pattern_->above.size()); ++p) {
    for (int c = 0; c < width_; ++c) {
      const int column = p * width_ + c;
      for (const int q : pattern_->above[static_cast<size_t>(p)]) {
        for (int r = 0; r < 3; ++r) matrix_.insert(q * width_ + c / 3 * 3 + r, column) = 0;
      }
      for (int r = 0; r <= c; ++r) matrix_.insert(p * width_ + r, column) = 0;
    }
  }
  matrix_.makeCompressed();
}

int BlockSystem::offset(int above, int group) const {
  const std::vector<int>& places = pattern_->above[static_cast<size_t>(group)];
  return 3 * static_cast<int>(std::lower_bound(places.begin(), places.end(), above) - places.begin());
}

void BlockSystem::add(int group, const Eigen::Ref<const Eigen::MatrixXd>& block) {
  const int p = pattern_->place[static_cast<size_t>(group)];
  const int start = 3 * static_cast<int>(pattern_->above[static_cast<size_t>(p)].size());
  for (int c = 0; c < width_; ++c) {
    double* column = matrix_.valuePtr() + matrix_.outerIndexPtr()[p * width_ + c] + start;
    for (int r = 0; r <= c; ++r) column[r] += block(r, c);
  }
}

void BlockSystem::add(int i, int j, int row, const Eigen::Matrix3d& block) {
  const int p = pattern_->place[static_cast<size_t>(i)], q = pattern_->place[static_cast<size_t>(j)];
  const int start = offset(std::min(p, q), std::max(p, q));
  for (int c = 0; c < 3; ++c) {
    double* column = matrix_.valuePtr() + matrix_.outerIndexPtr()[std::max(p, q) * width_ + 3 * row + c] + start;
    for (int r = 0; r < 3; ++r) column[r] += p < q ? block(r, c) : block(c, r);
  }
}

BlockSystem::Stars BlockSystem::stars(
    const Eigen::Ref<const Eigen::Matrix<int, Eigen::Dynamic, 2, Eigen::RowMajor>>& pairs) const {
  Stars stars{std::vector<int>(pattern_->place.size() + 1, 0), {}};
  for (const int group : pairs.reshaped()) ++stars.offsets[static_cast<size_t>(group) + 1];
  std::partial_sum(stars.offsets.begin(), stars.offsets.end(), stars.offsets.begin());
  stars.rays.resize(static_cast<size_t>(pairs.size()));
  std::vector<int> next(stars.offsets.begin(), stars.offsets.end() - 1);
  for (int pair = 0; pair < pairs.rows(); ++pair) {
    for (int side = 0; side < 2; ++side) {
      const auto group = static_cast<size_t>(pairs(pair, side)), other = static_cast<size_t>(pairs(pair, 1 - side));
      const int p = pattern_->place[group], q = pattern_->place[other];
      stars.rays[static_cast<size_t>(next[group]++)] = {pair, q < p ? offset(q, p) : -1};
    }
  }
  return stars;
}

void BlockSystem::add_differences(const Stars& stars,
                                  const Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>& blocks) {
  constexpr std::array<std::array<int, 3>, 3> kPacked = {{{0, 1, 2}, {1, 3, 4}, {2, 4, 5}}};
  const auto groups = static_cast<Eigen::Index>(pattern_->place.size());
#pragma omp parallel for schedule(static) if (groups > kGroupsWorthThreads)
  for (Eigen::Index group = 0; group < groups; ++group) {
    const auto p = static_cast<size_t>(pattern_->place[static_cast<size_t>(group)]);
    const std::array<double*, 3> columns = {matrix_.valuePtr() + matrix_.outerIndexPtr()[3 * p],
                                            matrix_.valuePtr() + matrix_.outerIndexPtr()[3 * p + 1],
                                            matrix_.valuePtr() + matrix_.outerIndexPtr()[3 * p + 2]};
    const auto start = 3 * pattern_->above[p].size();
    for (int k = stars.offsets[static_cast<size_t>(group)]; k < stars.offsets[static_cast<size_t>(group) + 1]; ++k) {
      const Stars::Ray& ray = stars.rays[static_cast<size_t>(k)];
      const double* block = blocks.data() + Eigen::Index{6} * ray.pair;
      for (size_t c = 0; c < 3; ++c) {
        for (size_t r = 0; r <= c; ++r) columns[c][start + r] += block[kPacked[c][r]];
        if (ray.above < 0) continue;
        for (size_t r = 0; r < 3; ++r) columns[c][static_cast<size_t>(ray.above) + r] -= block[kPacked[c][r]];
      }
    }
  }
}

void BlockSystem::factor(const Poll& poll) {
  if (!analyzed_) factor_->analyze(matrix_);
  analyzed_ = true;
  ask(poll);
  const int first = factor_->factorize(matrix_);
  if (first < 0) return;
  const auto group =
      std::find(pattern_->place.begin(), pattern_->place.end(), first / width_) - pattern_->place.begin();
  throw Indefinite(unknowns(), static_cast<int>(group));
}

Eigen::MatrixXd BlockSystem::solve(const Eigen::Ref<const Eigen::MatrixXd>& right_hand_sides) const {
  Eigen::MatrixXd columns;
  into_order(right_hand_sides, columns);
  factor_->solve(columns);
  return as_given(columns);
}

bool BlockSystem::keep_single() {
  panels_ = panels_of<SinglePanels>(*factor_);
  if (!panels_) return false;
  const Eigen::VectorXd solution =
      Eigen::VectorXd::NullaryExpr(unknowns(), [](Eigen::Index i) { return std::sin(static_cast<double>(i)); });
  const Eigen::VectorXd found = improved(times(solution), Eigen::VectorXd::Zero(unknowns()));
  if ((found - solution).norm() < kWorstError * solution.norm()) {
    kept_entries_ = factor_->entries();
    factor_.reset();
  } else {
    panels_.reset();
  }
  return single();
}

Eigen::VectorXd BlockSystem::improved(const Eigen::Ref<const Eigen::VectorXd>& right_hand_side,
                                      const Eigen::Ref<const Eigen::VectorXd>& guess) const {
  Eigen::MatrixXd left, start;
  into_order(right_hand_side, left);
  into_order(guess, start);
  Eigen::VectorXd image;
  multiply(start.col(0), image);
  left.col(0) -= image;
  panels_->solve(left.col(0));
  return as_given(start + left);
}

Eigen::VectorXd BlockSystem::solve_near(const Eigen::Ref<const Eigen::VectorXd>& right_hand_side,
                                        const Eigen::Ref<const Eigen::VectorXd>& guess) {
  if (factor_is_near_) {
    Eigen::MatrixXd sides, solution;
    into_order(right_hand_side, sides);
    into_order(guess, solution);
    const Eigen::VectorXd side = sides.col(0);
    Eigen::VectorXd near = solution.col(0);
    const Gradients done = conjugate_gradients([this](const Eigen::VectorXd& x, Eigen::VectorXd& y) { multiply(x, y); },
                                               [this](const Eigen::VectorXd& residual, Eigen::VectorXd& error) {
                                                 error = residual;
                                                 panels_ ? panels_->solve(error) : factor_->solve(error);
                                               },
                                               side, kNear, kIterationsOfAFactor, near);
    factor_is_near_ = 2 * done.iterations <= kIterationsOfAFactor;
    if (done.converged) return as_given(near);
  }
  factor();
  panels_ = panels_of<SinglePanels>(*factor_);
  factor_is_near_ = true;
  return solve(right_hand_side);
}

std::size_t BlockSystem::bytes() const {
  const std::size_t matrix = static_cast<size_t>(matrix_.nonZeros()) * (sizeof(double) + sizeof(int));
  return matrix + (panels_ ? panels_->bytes() : static_cast<size_t>(factor_entries()) * sizeof(double));
}

Eigen::VectorXd BlockSystem::times(const Eigen::Ref<const Eigen::VectorXd>& vector) const {
  Eigen::VectorXd product;
  if (pattern_->as_given) {
    multiply(vector, product);
    return product;
  }
  Eigen::MatrixXd ordered;
  into_order(vector, ordered);
  multiply(ordered.col(0), product);
  return as_given(product);
}

void BlockSystem::multiply(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::VectorXd& y) const {
  y.resize(unknowns());
  width_ == 3 ? multiply_rows<1>(x.data(), y.data()) : multiply_rows<3>(x.data(), y.data());
}

template <int kRows>
void BlockSystem::multiply_rows(const double* x, double* y) const {
  constexpr int kWidth = 3 * kRows;
  using Rows = Eigen::Matrix<double, 3, kRows>;
  const auto entries = [this](Eigen::Index column, Eigen::Index first) {
    return matrix_.valuePtr() + matrix_.outerIndexPtr()[column] + first;
  };
  const auto groups = static_cast<Eigen::Index>(pattern_->above.size());
#pragma omp parallel for schedule(static) if (groups > kGroupsWorthThreads)
  for (Eigen::Index p = 0; p < groups; ++p) {
    const std::vector<int>& above = pattern_->above[static_cast<size_t>(p)];
    Rows sum = Rows::Zero();
    for (size_t k = 0; k < above.size(); ++k) {
      const Eigen::Map<const Rows> theirs(x + Eigen::Index{above[k]} * kWidth);
      for (int c = 0; c < kWidth; ++c) {
        const Eigen::Map<const Eigen::Vector3d> column(entries(p * kWidth + c, 3 * static_cast<Eigen::Index>(k)));
        sum(c % 3, c / 3) += column.dot(theirs.col(c / 3));
      }
    }
    for (const Ray& ray : pattern_->below[static_cast<size_t>(p)]) {
      const double* theirs = x + Eigen::Index{ray.place} * kWidth;
      for (int c = 0; c < kWidth; ++c) {
        sum.col(c / 3) +=
            theirs[c] * Eigen::Map<const Eigen::Vector3d>(entries(Eigen::Index{ray.place} * kWidth + c, ray.above));
      }
    }
    for (int c = 0; c < kWidth; ++c) {
      const double* column = entries(p * kWidth + c, 3 * static_cast<Eigen::Index>(above.size()));
      const double* mine = x + p * kWidth;
      for (int r = 0; r < c; ++r) {
        sum(r % 3, r / 3) += column[r] * mine[c];
        sum(c % 3, c / 3) += column[r] * mine[r];
      }
      sum(c % 3, c / 3) += column[c] * mine[c];
    }
    Eigen::Map<Rows>(y + p * kWidth) = sum;
  }
}

void BlockSystem::into_order(const Eigen::Ref<const Eigen::MatrixXd>& columns, Eigen::MatrixXd& ordered) const {
  ordered.resize(columns.rows(), columns.cols());
  const auto groups = static_cast<Eigen::Index>(pattern_->place.size());
#pragma omp parallel for schedule(static) if (groups > kGroupsWorthThreads)
  for (Eigen::Index g = 0; g < groups; ++g) {
    ordered.middleRows(Eigen::Index{pattern_->place[static_cast<size_t>(g)]} * width_, width_) =
        columns.middleRows(g * width_, width_);
  }
}

Eigen::MatrixXd BlockSystem::as_given(const Eigen::MatrixXd& ordered) const {
  Eigen::MatrixXd result(ordered.rows(), ordered.cols());
  const auto groups = static_cast<Eigen::Index>(pattern_->place.size());
#pragma omp parallel for schedule(static) if (groups > kGroupsWorthThreads)
  for (Eigen::Index g = 0; g < groups; ++g) {
    result.middleRows(g * width_, width_) =
        ordered.middleRows(Eigen::Index{pattern_->place[static_cast<size_t>(g)]} * width_, width_);
  }
  return result;
}

}  // namespace swage
