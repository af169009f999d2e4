#include "panels.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace swage {
namespace {

constexpr int kBranches = 8;
constexpr int kLargest = 6;                           // Part of all values that a subtree of a branch may hold.
constexpr std::size_t kValuesWorthThreads = 500'000;  // Values. Fewer are read sooner than threads have met.

/// The panel in which each one's first row below its columns is a column: its parent in the elimination tree, or -1.
std::vector<int> parents(const Supernodes& source) {
  const auto count = source.columns.size() - 1;
  std::vector<int> panel_of_column(static_cast<size_t>(source.columns.back()));
  for (size_t p = 0; p < count; ++p) {
    std::fill(panel_of_column.begin() + source.columns[p], panel_of_column.begin() + source.columns[p + 1],
              static_cast<int>(p));
  }
  std::vector<int> parent(count, -1);
  for (size_t p = 0; p < count; ++p) {
    const int first_below = source.row_offsets[p] + source.columns[p + 1] - source.columns[p];
    if (first_below == source.row_offsets[p + 1]) continue;
    parent[p] = panel_of_column[static_cast<size_t>(source.rows[static_cast<size_t>(first_below)])];
  }
  return parent;
}

/// Values in each panel and all below it in the tree.
std::vector<std::int64_t> sizes_of_subtrees(const Supernodes& source, const std::vector<int>& parent) {
  std::vector<std::int64_t> size(parent.size());
  for (size_t p = 0; p < size.size(); ++p) {
    size[p] += source.value_offsets[p + 1] - source.value_offsets[p];
    if (parent[p] >= 0) size[static_cast<size_t>(parent[p])] += size[p];
  }
  return size;
}

/// The branch of each panel, or kBranches for the trunk: subtrees small enough to share out evenly, the largest first,
/// each to the branch that has least.
std::vector<int> branches(const std::vector<int>& parent, const std::vector<std::int64_t>& size, std::int64_t largest) {
  auto in_trunk = [&](int p) { return p < 0 || size[static_cast<size_t>(p)] > largest; };
  std::vector<int> roots;
  for (int p = 0; p < static_cast<int>(parent.size()); ++p) {
    if (!in_trunk(p) && in_trunk(parent[static_cast<size_t>(p)])) roots.push_back(p);
  }
  std::stable_sort(roots.begin(), roots.end(),
                   [&](int a, int b) { return size[static_cast<size_t>(a)] > size[static_cast<size_t>(b)]; });
  std::vector<int> branch(parent.size(), kBranches);
  std::vector<std::int64_t> load(kBranches, 0);
  for (const int root : roots) {
    const auto least = std::min_element(load.begin(), load.end());
    *least += size[static_cast<size_t>(root)];
    branch[static_cast<size_t>(root)] = static_cast<int>(least - load.begin());
  }
  for (int p = static_cast<int>(parent.size()) - 1; p >= 0; --p) {
    const int up = parent[static_cast<size_t>(p)];
    if (up >= 0 && branch[static_cast<size_t>(up)] != kBranches) {
      branch[static_cast<size_t>(p)] = branch[static_cast<size_t>(up)];
    }
  }
  return branch;
}

constexpr int kAtOnce = 4;  // Columns of a panel: the rows below are read and written once for all of them.

/// `n` columns of a panel from column c on.
template <typename Scalar, int n>
struct Columns {
  using Block = Eigen::Map<const Eigen::Matrix<Scalar, Eigen::Dynamic, n>, 0, Eigen::OuterStride<>>;

  Columns(const Scalar* values, int rows, int c)
      : diagonal(values + std::ptrdiff_t{c} * rows + c, n, n, Eigen::OuterStride<>(rows)),
        below(values + std::ptrdiff_t{c} * rows + c + n, rows - c - n, n, Eigen::OuterStride<>(rows)) {}

  Block diagonal, below;
};

/// Solves for the columns, and takes from the rows below what they give there.
template <int n, typename Scalar, int kSides>
void take_columns(const Columns<Scalar, n>& columns, int c, Eigen::Matrix<Scalar, Eigen::Dynamic, kSides>& work) {
  Eigen::Matrix<Scalar, n, kSides> x = work.template middleRows<n>(c);
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < k; ++j) x.row(k) -= columns.diagonal(k, j) * x.row(j);
    x.row(k) /= columns.diagonal(k, k);
  }
  work.template middleRows<n>(c) = x;
  work.middleRows(c + n, columns.below.rows()).noalias() -= columns.below.lazyProduct(x);
}

/// Takes from the columns what the rows below give to them, and solves for them by the transpose.
template <int n, typename Scalar, int kSides>
void give_columns(const Columns<Scalar, n>& columns, int c, Eigen::Matrix<Scalar, Eigen::Dynamic, kSides>& work) {
  Eigen::Matrix<Scalar, n, kSides> x = work.template middleRows<n>(c);
  x -= columns.below.transpose().lazyProduct(work.middleRows(c + n, columns.below.rows()));
  for (int k = n - 1; k >= 0; --k) {
    for (int j = k + 1; j < n; ++j) x.row(k) -= columns.diagonal(j, k) * x.row(j);
    x.row(k) /= columns.diagonal(k, k);
  }
  work.template middleRows<n>(c) = x;
}

}  // namespace

template <typename Scalar, int kSides>
Panels<Scalar, kSides>::Panels(const Supernodes& source) {
  const std::vector<int> place = cut(source);
  copy(source, place);
  place_.resize(place.size());
  for (size_t c = 0; c < place.size(); ++c) place_[static_cast<size_t>(source.order[c])] = place[c];
}

template <typename Scalar, int kSides>
std::vector<int> Panels<Scalar, kSides>::cut(const Supernodes& source) {
  const std::vector<int> parent = parents(source);
  const std::vector<int> branch =
      branches(parent, sizes_of_subtrees(source, parent), source.value_offsets.back() / kLargest);
  order_.resize(branch.size());
  std::iota(order_.begin(), order_.end(), 0);
  // Stable: children stay before their parents.
  std::stable_sort(order_.begin(), order_.end(),
                   [&](int a, int b) { return branch[static_cast<size_t>(a)] < branch[static_cast<size_t>(b)]; });
  for (int b = 0; b < kBranches; ++b) {
    branch_ends_.push_back(static_cast<int>(
        std::partition_point(order_.begin(), order_.end(), [&](int p) { return branch[static_cast<size_t>(p)] <= b; }) -
        order_.begin()));
  }
  std::vector<int> place(static_cast<size_t>(source.columns.back()));
  int column = 0;
  for (size_t i = 0; i < order_.size(); ++i) {
    if (static_cast<int>(i) == branch_ends_.back()) trunk_ = column;
    const auto p = static_cast<size_t>(order_[i]);
    for (int c = source.columns[p]; c < source.columns[p + 1]; ++c) place[static_cast<size_t>(c)] = column++;
  }
  if (branch_ends_.back() == static_cast<int>(order_.size())) trunk_ = column;
  return place;
}

template <typename Scalar, int kSides>
void Panels<Scalar, kSides>::copy(const Supernodes& source, const std::vector<int>& place) {
  rows_.reserve(source.rows.size());
  values_.reserve(static_cast<size_t>(source.value_offsets.back()));
  for (const int p : order_) {
    const auto at = static_cast<size_t>(p);
    Panel panel{};
    panel.first = place[static_cast<size_t>(source.columns[at])];
    panel.columns = source.columns[at + 1] - source.columns[at];
    panel.below = source.row_offsets[at + 1] - source.row_offsets[at] - panel.columns;
    panel.rows = static_cast<std::ptrdiff_t>(rows_.size());
    panel.values = static_cast<std::ptrdiff_t>(values_.size());
    const bool of_trunk = panel.first >= trunk_;
    for (int i = source.row_offsets[at] + panel.columns; i < source.row_offsets[at + 1]; ++i) {
      const int row = place[static_cast<size_t>(source.rows[static_cast<size_t>(i)])];
      rows_.push_back(row);
      if (of_trunk || row < trunk_) ++panel.inside;
    }
    values_.insert(values_.end(), source.values + source.value_offsets[at],
                   source.values + source.value_offsets[at + 1]);
    most_rows_ = std::max(most_rows_, panel.columns + panel.below);
    panels_.push_back(panel);
  }
}

template <typename Scalar, int kSides>
void Panels<Scalar, kSides>::forward(const Panel& panel, Rows& x, Rows* trunk, Work& work) const {
  const int rows_of_panel = panel.columns + panel.below;
  const Scalar* values = values_.data() + panel.values;
  for (int s = 0; s < kSides; ++s) {
    Scalar* side = work.col(s).data();
    for (int c = 0; c < panel.columns; ++c) side[c] = x(panel.first + c, s);
    std::fill(side + panel.columns, side + rows_of_panel, Scalar{0});
  }
  int c = 0;
  for (; c + kAtOnce <= panel.columns; c += kAtOnce)
    take_columns<kAtOnce, Scalar, kSides>({values, rows_of_panel, c}, c, work);
  for (; c < panel.columns; ++c) take_columns<1, Scalar, kSides>({values, rows_of_panel, c}, c, work);
  x.middleRows(panel.first, panel.columns) = work.topRows(panel.columns);
  const int* rows = rows_.data() + panel.rows;
  for (int i = 0; i < panel.inside; ++i) x.row(rows[i]) += work.row(panel.columns + i);
  for (int i = panel.inside; i < panel.below; ++i) trunk->row(rows[i] - trunk_) += work.row(panel.columns + i);
}

template <typename Scalar, int kSides>
void Panels<Scalar, kSides>::backward(const Panel& panel, Rows& x, Work& work) const {
  const int rows_of_panel = panel.columns + panel.below;
  const Scalar* values = values_.data() + panel.values;
  const int* rows = rows_.data() + panel.rows;
  work.topRows(panel.columns) = x.middleRows(panel.first, panel.columns);
  for (int i = 0; i < panel.below; ++i) work.row(panel.columns + i) = x.row(rows[i]);
  int c = panel.columns;
  for (; c % kAtOnce != 0; --c) give_columns<1, Scalar, kSides>({values, rows_of_panel, c - 1}, c - 1, work);
  for (; c > 0; c -= kAtOnce)
    give_columns<kAtOnce, Scalar, kSides>({values, rows_of_panel, c - kAtOnce}, c - kAtOnce, work);
  x.middleRows(panel.first, panel.columns) = work.topRows(panel.columns);
}

template <typename Scalar, int kSides>
void Panels<Scalar, kSides>::solve(Eigen::Ref<Sides> sides) const {
  Rows x(sides.rows(), kSides);
  for (Eigen::Index c = 0; c < sides.rows(); ++c) {
    x.row(place_[static_cast<size_t>(c)]) = sides.row(c).template cast<Scalar>();
  }
  const auto panel_count = static_cast<int>(panels_.size());
  // What each branch adds to the trunk.
  std::vector<Rows> sums(kBranches, Rows::Zero(x.rows() - trunk_, kSides));
  // A branch's own room, made outside of the loops: what they throw would end the program.
  std::vector<Work> works(kBranches, Work(most_rows_, kSides));
#pragma omp parallel for schedule(dynamic, 1) if (values_.size() > kValuesWorthThreads / kSides)
  for (int b = 0; b < kBranches; ++b) {
    Rows& trunk = sums[static_cast<size_t>(b)];
    for (int p = b == 0 ? 0 : branch_ends_[static_cast<size_t>(b - 1)]; p < branch_ends_[static_cast<size_t>(b)]; ++p) {
      forward(panels_[static_cast<size_t>(p)], x, &trunk, works[static_cast<size_t>(b)]);
    }
  }
  Work& work = works.front();
  for (const Rows& sum : sums) x.bottomRows(sum.rows()) += sum;
  for (int p = branch_ends_.back(); p < panel_count; ++p) forward(panels_[static_cast<size_t>(p)], x, nullptr, work);
  for (int p = panel_count - 1; p >= branch_ends_.back(); --p) backward(panels_[static_cast<size_t>(p)], x, work);
#pragma omp parallel for schedule(dynamic, 1) if (values_.size() > kValuesWorthThreads / kSides)
  for (int b = 0; b < kBranches; ++b) {
    const int begin = b == 0 ? 0 : branch_ends_[static_cast<size_t>(b - 1)];
    for (int p = branch_ends_[static_cast<size_t>(b)] - 1; p >= begin; --p) {
      backward(panels_[static_cast<size_t>(p)], x, works[static_cast<size_t>(b)]);
    }
  }
  for (Eigen::Index c = 0; c < sides.rows(); ++c) {
    sides.row(c) = x.row(place_[static_cast<size_t>(c)]).template cast<double>();
  }
}

template class Panels<float, 1>;
template class Panels<double, 3>;

}  // namespace swage
