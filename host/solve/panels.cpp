#include "panels.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace swage {
namespace {

constexpr int kBranches = 8;
constexpr int kLargest = 6;                     // Part of all values that a subtree of a branch may hold.
constexpr std::size_t kWorthThreads = 500'000;  // Values. Fewer are read sooner than threads have met.

/// The panel in which each one's first row below its columns is a column: its parent in the elimination tree, or -1.
std::vector<int> parents(const Panels::Source& source) {
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
std::vector<std::int64_t> sizes_of_subtrees(const Panels::Source& source, const std::vector<int>& parent) {
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

}  // namespace

Panels::Panels(const Source& source) {
  const std::vector<int> place = cut(source);
  copy(source, place);
  place_.resize(place.size());
  for (size_t c = 0; c < place.size(); ++c) place_[static_cast<size_t>(source.order[c])] = place[c];
}

std::vector<int> Panels::cut(const Source& source) {
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

void Panels::copy(const Source& source, const std::vector<int>& place) {
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

void Panels::forward(const Panel& panel, Eigen::VectorXf& x, float* trunk, Eigen::VectorXf& work) const {
  const int rows_of_panel = panel.columns + panel.below;
  auto own = x.segment(panel.first, panel.columns);
  work.head(rows_of_panel).setZero();
  work.head(panel.columns) = own;
  for (int c = 0; c < panel.columns; ++c) {
    const Column column = below_diagonal(panel, c);
    own[c] = work[c] / diagonal(panel, c);
    work.segment(c + 1, column.size()) -= own[c] * column;
  }
  const int* rows = rows_.data() + panel.rows;
  for (int i = 0; i < panel.inside; ++i) x[rows[i]] += work[panel.columns + i];
  for (int i = panel.inside; i < panel.below; ++i) trunk[rows[i] - trunk_] += work[panel.columns + i];
}

void Panels::backward(const Panel& panel, Eigen::VectorXf& x, Eigen::VectorXf& work) const {
  auto own = x.segment(panel.first, panel.columns);
  const int* rows = rows_.data() + panel.rows;
  work.head(panel.columns) = own;
  for (int i = 0; i < panel.below; ++i) work[panel.columns + i] = x[rows[i]];
  for (int c = panel.columns - 1; c >= 0; --c) {
    const Column column = below_diagonal(panel, c);
    work[c] = (work[c] - column.dot(work.segment(c + 1, column.size()))) / diagonal(panel, c);
  }
  own = work.head(panel.columns);
}

float Panels::diagonal(const Panel& panel, int column) const {
  return values_[static_cast<size_t>(panel.values + std::ptrdiff_t{column} * (panel.columns + panel.below) + column)];
}

Panels::Column Panels::below_diagonal(const Panel& panel, int column) const {
  const int rows_of_panel = panel.columns + panel.below;
  return {values_.data() + panel.values + std::ptrdiff_t{column} * rows_of_panel + column + 1,
          rows_of_panel - column - 1};
}

void Panels::solve(Eigen::Ref<Eigen::VectorXd> column) const {
  Eigen::VectorXf x(column.size());
  for (Eigen::Index c = 0; c < column.size(); ++c) x[place_[static_cast<size_t>(c)]] = static_cast<float>(column[c]);
  const auto panel_count = static_cast<int>(panels_.size());
  // What each branch adds to the trunk.
  Eigen::MatrixXf sums = Eigen::MatrixXf::Zero(x.size() - trunk_, kBranches);
#pragma omp parallel for schedule(dynamic, 1) if (values_.size() > kWorthThreads)
  for (int b = 0; b < kBranches; ++b) {
    Eigen::VectorXf work(most_rows_);
    float* trunk = sums.data() + b * sums.rows();
    for (int p = b == 0 ? 0 : branch_ends_[static_cast<size_t>(b - 1)]; p < branch_ends_[static_cast<size_t>(b)]; ++p) {
      forward(panels_[static_cast<size_t>(p)], x, trunk, work);
    }
  }
  Eigen::VectorXf work(most_rows_);
  x.tail(sums.rows()) += sums.rowwise().sum();
  for (int p = branch_ends_.back(); p < panel_count; ++p) forward(panels_[static_cast<size_t>(p)], x, nullptr, work);
  for (int p = panel_count - 1; p >= branch_ends_.back(); --p) backward(panels_[static_cast<size_t>(p)], x, work);
#pragma omp parallel for schedule(dynamic, 1) if (values_.size() > kWorthThreads)
  for (int b = 0; b < kBranches; ++b) {
    Eigen::VectorXf own_work(most_rows_);
    const int begin = b == 0 ? 0 : branch_ends_[static_cast<size_t>(b - 1)];
    for (int p = branch_ends_[static_cast<size_t>(b)] - 1; p >= begin; --p) {
      backward(panels_[static_cast<size_t>(p)], x, own_work);
    }
  }
  for (Eigen::Index c = 0; c < column.size(); ++c) column[c] = static_cast<double>(x[place_[static_cast<size_t>(c)]]);
}

}  // namespace swage
