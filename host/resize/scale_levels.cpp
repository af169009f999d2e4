#include "scale_levels.h"

#include <algorithm>

#include "vectors.h"

namespace swage {
namespace {

using Eigen::Index;

constexpr float kDamping = 0.85F;

bool coarsest(const ScaleLayout& layout) {
  for (int u = 0; u < 3; ++u) {
    const Extents& extents = layout.extents[static_cast<size_t>(u)];
    if (extents.count() > extents[u]) return false;
  }
  return true;
}

Values<float> inverse(const Values<float>& diagonal) {
  return (diagonal.array() > 0).select(diagonal.cwiseInverse(), 0.0F);
}

}  // namespace

ScaleLevels::ScaleLevels(const ScaleMatrix<double>& matrix) {
  const Extents& cells = matrix.layout.extents[0];
  Level& finest = levels_.emplace_back(matrix.layout);
  finest.matrix.neighbours = matrix.neighbours.cast<float>();
  for (size_t side = 0; side < 2; ++side) finest.matrix.weights[side] = matrix.weights[side].cast<float>();
  while (!coarsest(levels_.back().matrix.layout)) {
    levels_.emplace_back(ScaleLayout(cells, static_cast<int>(levels_.size())));
    merge_weights(levels_[levels_.size() - 2], levels_.back());
  }
  for (Level& level : levels_) {
    for (Values<float>* values : {&level.residual, &level.error, &level.image, &level.matrix.diagonal}) {
      values->setZero(level.matrix.layout.size);
    }
  }
  const ScaleLayout& layout = levels_.back().matrix.layout;
  for (int u = 0; u < 3; ++u) {
    for (Index i = 0; i < cells[u]; ++i) coarsest_.push_back(layout.begins[static_cast<size_t>(u)] + i);
  }
}

void ScaleLevels::merge_weights(const Level& fine, Level& coarse) const {
  const ScaleLayout &from = fine.matrix.layout, &to = coarse.matrix.layout;
  for (Values<float>& weights : coarse.matrix.weights) weights.setZero(to.size);
  Values<float>& neighbours = coarse.matrix.neighbours;
  neighbours.setZero(to.size);
  for (size_t u = 0; u < 3; ++u) {
    const Extents &extents = from.extents[u], &merged = to.extents[u];
    for (size_t side = 0; side < 2; ++side) {
      const int v = side == 0 ? next(static_cast<int>(u)) : next(next(static_cast<int>(u)));
      gather_weights(extents, across(static_cast<int>(u)), v, fine.matrix.weights[side].data() + from.begins[u],
                     coarse.matrix.weights[side].data() + to.begins[u]);
      const Index step = merged.stride(v);
      const Values<float>& weights = coarse.matrix.weights[side];
      neighbours.segment(to.begins[u], merged.count()) +=
          weights.segment(to.begins[u], merged.count()) + weights.segment(to.begins[u] - step, merged.count());
    }
  }
}

void ScaleLevels::merge_values(const Level& fine, Level& coarse) const {
  const ScaleLayout &from = fine.matrix.layout, &to = coarse.matrix.layout;
  const Values<float> own = fine.matrix.diagonal - fine.matrix.neighbours;
  for (int u = 0; u < 3; ++u) {
    const auto at = static_cast<size_t>(u);
    gather(from.extents[at], across(u), own.data() + from.begins[at], coarse.matrix.diagonal.data() + to.begins[at]);
    Merged merged = {};
    merged[static_cast<size_t>(next(next(u)))] = true;
    coarse.matrix.pairs[at].resize(coarse.matrix.pair_extents(u).count());
    gather(fine.matrix.pair_extents(u), merged, fine.matrix.pairs[at].data(), coarse.matrix.pairs[at].data());
  }
  coarse.matrix.diagonal += coarse.matrix.neighbours;
}

void ScaleLevels::fill(const ScaleMatrix<double>& matrix) {
  levels_[0].matrix.diagonal = matrix.diagonal.cast<float>();
  for (size_t p = 0; p < 3; ++p) levels_[0].matrix.pairs[p] = matrix.pairs[p].cast<float>();
  for (size_t l = 1; l < levels_.size(); ++l) {
    merge_values(levels_[l - 1], levels_[l]);
    levels_[l].jacobi = inverse(levels_[l].matrix.diagonal);
    RowSpread<float> rows = smoother(levels_[l]);
    rows.sum();
    levels_[l].inverse_sums = rows.inverse_sums;
  }
  factor_coarsest();
}

void ScaleLevels::hold(const Values<double>& free, bool all_free) {
  Level& finest = levels_[0];
  free_ = free;
  all_free_ = all_free;
  finest.jacobi = inverse(finest.matrix.diagonal).cwiseProduct(free.cast<float>());
  RowSpread<float> rows = smoother(finest);
  rows.sum();
  finest.inverse_sums = rows.inverse_sums;
  RowSpread<double> all{finest.matrix.layout, free_};
  all.sum();
  inverse_free_ = all.inverse_sums;
  mask_ = free_.cast<float>();
  inverse_mask_ = inverse_free_.cast<float>();
}

void ScaleLevels::factor_coarsest() {
  Level& level = levels_.back();
  const auto count = static_cast<Index>(coarsest_.size());
  Eigen::MatrixXd matrix(count, count), project = Eigen::MatrixXd::Identity(count, count);
  for (Index i = 0; i < count; ++i) {
    level.error.setZero();
    level.error[coarsest_[static_cast<size_t>(i)]] = 1;
    level.matrix.multiply(level.error, level.image);
    for (Index j = 0; j < count; ++j) matrix(j, i) = level.image[coarsest_[static_cast<size_t>(j)]];
  }
  Index begin = 0;
  for (int u = 0; u < 3; ++u) {
    const Index row = level.matrix.layout.extents[static_cast<size_t>(u)][u];
    project.block(begin, begin, row, row).array() -= 1.0 / static_cast<double>(row);
    begin += row;
  }
  // What the rows' sums forbid is given a diagonal; a little more lets rounding be.
  const double size = std::max(matrix.diagonal().maxCoeff(), 1e-30);
  matrix = (project * matrix * project).eval();
  matrix += size * (Eigen::MatrixXd::Identity(count, count) - project);
  matrix.diagonal().array() += 1e-7 * size;
  factor_.compute(matrix);
}

void ScaleLevels::solve_coarsest(Level& level) const {
  const auto count = static_cast<Index>(coarsest_.size());
  Eigen::VectorXd side(count);
  const auto project = [&] {
    Index begin = 0;
    for (int u = 0; u < 3; ++u) {
      const Index row = level.matrix.layout.extents[static_cast<size_t>(u)][u];
      side.segment(begin, row).array() -= side.segment(begin, row).mean();
      begin += row;
    }
  };
  for (Index i = 0; i < count; ++i) side[i] = level.residual[coarsest_[static_cast<size_t>(i)]];
  project();
  factor_.solveInPlace(side);
  project();
  for (Index i = 0; i < count; ++i) level.error[coarsest_[static_cast<size_t>(i)]] = static_cast<float>(side[i]);
}

void ScaleLevels::descend(size_t at) {
  Level& level = levels_[at];
  if (at + 1 == levels_.size() && at > 0) return solve_coarsest(level);
  const RowSpread<float> smooth = smoother(level);
  smooth.apply<false>(kDamping, level.residual, level.error);
  if (at + 1 == levels_.size()) return;
  const ScaleLayout& layout = level.matrix.layout;
  const RowSpread<float> keep_rows{layout, mask_, inverse_mask_};
  level.matrix.multiply(level.error, level.image);
  combine(1, level.residual, -1, level.image);
  if (at == 0 && !all_free_) keep_rows.apply<false>(1, level.image, level.image);
  Level& coarse = levels_[at + 1];
  for (int u = 0; u < 3; ++u) {
    const auto axis = static_cast<size_t>(u);
    gather(layout.extents[axis], across(u), level.image.data() + layout.begins[axis],
           coarse.residual.data() + coarse.matrix.layout.begins[axis]);
  }
  descend(at + 1);
  for (int u = 0; u < 3; ++u) {
    const auto axis = static_cast<size_t>(u);
    scatter_add(layout.extents[axis], across(u), coarse.error.data() + coarse.matrix.layout.begins[axis],
                level.error.data() + layout.begins[axis]);
  }
  if (at == 0 && !all_free_) keep_rows.apply<false>(1, level.error, level.error);
  level.matrix.multiply(level.error, level.image);
  combine(1, level.residual, -1, level.image);
  smooth.apply<true>(kDamping, level.image, level.error);
}

void ScaleLevels::cycle(const Values<double>& residual, Values<double>& error) {
  Level& finest = levels_[0];
  const RowSpread<double> free{finest.matrix.layout, free_, inverse_free_};
  free.apply<false>(1, residual, finest.residual);
  descend(0);
  free.apply<false>(1, finest.error, error);
}

}  // namespace swage
