#include "scale_levels.h"

#include <algorithm>

#include "correction.h"

namespace swage {
namespace {

using Eigen::Index;

constexpr size_t kTwice = 2;  // So many levels below the finest are gone through twice on each way down.
constexpr float kDamping = 0.85F;
// Scales that are held hold those that they are merged with, by a spring so many times as strong as their neighbours.
constexpr float kHeld = 4;

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
  do {
    levels_.emplace_back(ScaleLayout(cells, static_cast<int>(levels_.size())));
    merge_weights(levels_[levels_.size() - 2], levels_.back());
  } while (!coarsest(levels_.back().matrix.layout));
  for (Level& level : levels_) {
    for (Values<float>* values : {&level.residual, &level.error, &level.image, &level.matrix.own}) {
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
  coarse.all_free.setZero(to.size);
  for (int u = 0; u < 3; ++u) {
    const auto at = static_cast<size_t>(u);
    gather(from.extents[at], across(u), fine.all_free.data() + from.begins[at], coarse.all_free.data() + to.begins[at]);
    Merged merged = {};
    merged[static_cast<size_t>(next(next(u)))] = true;
    coarse.matrix.pairs[at].resize(coarse.matrix.pair_extents(u).count());
    gather(fine.matrix.pair_extents(u), merged, fine.matrix.pairs[at].data(), coarse.matrix.pairs[at].data());
  }
}

void ScaleLevels::fill(const ScaleMatrix<double>& matrix) {
  Level& finest = levels_[0];
  finest.all_free = finest.matrix.own = matrix.own.cast<float>();
  for (size_t p = 0; p < 3; ++p) finest.matrix.pairs[p] = matrix.pairs[p].cast<float>();
  for (size_t l = 1; l < levels_.size(); ++l) merge_values(levels_[l - 1], levels_[l]);
}

void ScaleLevels::prepare_smoother(Level& level) const {
  level.jacobi = inverse(level.matrix.own + level.matrix.neighbours);
  if (&level == &levels_[0] && !all_free_) level.jacobi.array() *= free_.array();
  sum_rows(level.matrix.layout, level.jacobi, level.inverse_sums);
}

/// Makes what the coarser levels have beyond neighbours, with what holds those scales that are held.
void ScaleLevels::stiffen() {
  for (size_t l = 1; l < levels_.size(); ++l) levels_[l].matrix.own = levels_[l].all_free;
  if (all_free_) return;
  const ScaleMatrix<float>& finest = levels_[0].matrix;
  Values<float> springs = kHeld * (finest.own + finest.neighbours).array() * (1 - free_.array());
  for (size_t l = 1; l < levels_.size(); ++l) {
    const ScaleLayout &from = levels_[l - 1].matrix.layout, &to = levels_[l].matrix.layout;
    Values<float> merged = Values<float>::Zero(to.size);
    for (int u = 0; u < 3; ++u) {
      const auto at = static_cast<size_t>(u);
      gather(from.extents[at], across(u), springs.data() + from.begins[at], merged.data() + to.begins[at]);
    }
    levels_[l].matrix.own += merged;
    springs = std::move(merged);
  }
}

void ScaleLevels::hold(const Values<float>& free, bool all_free) {
  free_ = free;
  all_free_ = all_free;
  stiffen();
  for (Level& level : levels_) prepare_smoother(level);
  factor_coarsest();
}

void ScaleLevels::factor_coarsest() {
  const ScaleMatrix<float>& level = levels_.back().matrix;
  const auto count = static_cast<Index>(coarsest_.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count, count);
  std::array<Index, 3> begins, rows;
  for (size_t u = 0; u < 3; ++u) {
    rows[u] = level.layout.extents[u][static_cast<int>(u)];
    begins[u] = u == 0 ? 0 : begins[u - 1] + rows[u - 1];
  }
  for (Index i = 0; i < count; ++i) matrix(i, i) = level.own[coarsest_[static_cast<size_t>(i)]];
  for (size_t p = 0; p < 3; ++p) {
    const size_t q = (p + 1) % 3;
    for (Index e = 0; e < level.pairs[p].size(); ++e) {
      // The lower of the two axes runs faster.
      const Index low = e % rows[std::min(p, q)], high = e / rows[std::min(p, q)];
      const Index i = begins[p] + (p < q ? low : high), j = begins[q] + (p < q ? high : low);
      matrix(i, j) = matrix(j, i) = -level.pairs[p][e];
    }
  }
  // What the rows' sums forbid is given a diagonal; a little more lets rounding be.
  const double size = std::max(matrix.diagonal().maxCoeff(), 1e-30);
  matrix.diagonal() *= 1 + 1e-6;
  matrix.diagonal().array() += 1e-13 * size;
  for (size_t u = 0; u < 3; ++u) {
    auto across_rows = matrix.middleRows(begins[u], rows[u]);
    across_rows.rowwise() -= across_rows.colwise().mean().eval();
  }
  for (size_t u = 0; u < 3; ++u) {
    auto columns = matrix.middleCols(begins[u], rows[u]);
    columns.colwise() -= columns.rowwise().mean().eval();
    matrix.block(begins[u], begins[u], rows[u], rows[u]).array() += size / static_cast<double>(rows[u]);
  }
  factor_.compute(matrix);
}

void ScaleLevels::solve_coarsest(const Values<float>& residual, Values<float>& error) const {
  const ScaleLayout& layout = levels_.back().matrix.layout;
  const auto count = static_cast<Index>(coarsest_.size());
  Eigen::VectorXd side(count);
  const auto project = [&] {
    Index begin = 0;
    for (int u = 0; u < 3; ++u) {
      const Index row = layout.extents[static_cast<size_t>(u)][u];
      side.segment(begin, row).array() -= side.segment(begin, row).mean();
      begin += row;
    }
  };
  for (Index i = 0; i < count; ++i) side[i] = residual[coarsest_[static_cast<size_t>(i)]];
  project();
  factor_.solveInPlace(side);
  project();
  for (Index i = 0; i < count; ++i) error[coarsest_[static_cast<size_t>(i)]] = static_cast<float>(side[i]);
}

/// Adds what the next level finds.
void ScaleLevels::correct(size_t at, const Values<float>& residual, Values<float>& error) {
  Level &level = levels_[at], &coarse = levels_[at + 1];
  const ScaleLayout &layout = level.matrix.layout, &merged = coarse.matrix.layout;
  level.matrix.subtract(residual, error, level.image);
  level.rows().center(level.image, level.image);
  for (int u = 0; u < 3; ++u) {
    const auto axis = static_cast<size_t>(u);
    gather(layout.extents[axis], across(u), level.image.data() + layout.begins[axis],
           coarse.residual.data() + merged.begins[axis]);
  }
  descend_twice(at + 1);
  for (int u = 0; u < 3; ++u) {
    const auto axis = static_cast<size_t>(u);
    scatter_add(layout.extents[axis], across(u), coarse.error.data() + merged.begins[axis],
                error.data() + layout.begins[axis]);
  }
  if (at == 0 && !all_free_) level.rows().balance(error);
}

void ScaleLevels::descend(size_t at, const Values<float>& residual, Values<float>& error) {
  Level& level = levels_[at];
  if (at + 1 == levels_.size()) return solve_coarsest(residual, error);
  level.rows().spread<false>(kDamping, residual, error);
  correct(at, residual, error);
  level.matrix.subtract(residual, error, level.image);
  level.rows().spread<true>(kDamping, level.image, error);
}

void ScaleLevels::descend_twice(size_t at) {
  Level& level = levels_[at];
  const auto clear = [&](Values<float>& residual) { level.rows().center(residual, residual); };
  clear(level.residual);
  descend(at, level.residual, level.error);
  if (at > kTwice || at + 1 == levels_.size()) return;
  join_twice(
      level.matrix, [&](const Values<float>& rest, Values<float>& more) { descend(at, rest, more); }, clear,
      level.residual, level.error, level.twice);
}

void ScaleLevels::cycle(const Values<float>& residual, Values<float>& error) { descend(0, residual, error); }

}  // namespace swage
