#include "line_levels.h"

#include <algorithm>

#include "correction.h"

namespace swage {
namespace {

using Eigen::Index;

constexpr size_t kLinesTwice = 1;  // So many levels below the finest are gone through twice on each way down.
constexpr float kLinesDamping = 0.9F;
constexpr float kTie = 1000;  // How much stronger than all else vertices are tied, in the lines that smooth.
// Tied vertices hold those that they are merged with, by a spring so many times as strong as their neighbours.
constexpr float kLinesHeld = 2;
constexpr Merged kAcross = {true, true, false};

template <typename Scalar>
auto part(const Values<Scalar>& values, Index begin, Index count) {
  return values.segment(begin, count).array();
}

/// Of the lines' tridiagonal matrices: a vertex is held by those beside it and, through those before it, by the first.
/// What holds it and what ties it to the next are the pivot: nothing is subtracted, however unlike weights are.
void factor(const LineMatrix<float>& matrix, Values<float>& inverse_pivots) {
  const Index layer = matrix.layer();
  if (inverse_pivots.size() == 0) inverse_pivots.setZero(matrix.extents.count());
  Eigen::ArrayXf held = part(matrix.weights[2], 0, layer);
  for (Index i = 1; i + 1 < matrix.extents[2]; ++i) {
    const auto along = part(matrix.weights[2], i * layer, layer);
    held += part(matrix.across, i * layer, layer);
    inverse_pivots.segment(i * layer, layer).array() = 1.0F / (held + along);
    held *= along * part(inverse_pivots, i * layer, layer);
  }
}

/// Solves all lines for the damped sides. Adds that to what is there, and spoils the sides, or puts it.
template <bool kAdd, typename Sides>
void solve_lines(const Extents& extents, const Values<float>& along, const Values<float>& inverse_pivots, Sides& sides,
                 Values<float>& result) {
  constexpr Index kSide = 256;
  const Index layer = extents.stride(2), last = extents[2] - 2;
#pragma omp parallel for schedule(static) if (extents.count() > kManyEntries)
  for (Index begin = 0; begin < layer; begin += kSide) {
    const Index count = std::min(kSide, layer - begin);
    const auto solved = [&](Index i) {
      if constexpr (kAdd) {
        return sides.segment(i * layer + begin, count).array();
      } else {
        return result.segment(i * layer + begin, count).array();
      }
    };
    for (Index i = 1; i <= last; ++i) {
      const Index at = i * layer + begin, before = at - layer;
      if (i == 1) {
        solved(i) = kLinesDamping * part(sides, at, count) * part(inverse_pivots, at, count);
      } else {
        solved(i) = (kLinesDamping * part(sides, at, count) + part(along, before, count) * solved(i - 1)) *
                    part(inverse_pivots, at, count);
      }
    }
    for (Index i = last; i >= 1; --i) {
      const Index at = i * layer + begin;
      if (i < last) solved(i) += part(along, at, count) * part(inverse_pivots, at, count) * solved(i + 1);
      if constexpr (kAdd) result.segment(at, count).array() += solved(i);
    }
  }
}

}  // namespace

template <typename Scalar>
void LineMatrix<Scalar>::sum_across() {
  across = weights[0] + weights[1];
  for (int axis = 0; axis < 2; ++axis) {
    const Index stride = extents.stride(axis), count = extents.count() - stride;
    across.tail(count) += weights[static_cast<size_t>(axis)].head(count);
  }
}

namespace {

/// Calls work(begin, count, number) for stretches of the layers that are not held.
template <typename Scalar, typename Work>
void each_inner_stretch(const LineMatrix<Scalar>& matrix, const Work& work) {
  const Index layer = matrix.layer(), inner = std::max(matrix.extents.count() - 2 * layer, Index{0});
  each_stretch(inner, [&](Index begin, Index count, Index number) { work(layer + begin, count, number); });
}

template <typename Scalar>
void stencil(const LineMatrix<Scalar>& matrix, Index at, Index count, const Scalar* x, Scalar* __restrict product) {
  const Index b = matrix.extents.stride(1), c = matrix.layer();
  const Scalar *to_a = matrix.weights[0].data(), *to_b = matrix.weights[1].data(), *to_c = matrix.weights[2].data();
  // So written that little is lost where neighbours have about the same.
  for (Index i = at; i < at + count; ++i) {
    product[i] = to_a[i] * (x[i] - x[i + 1]) + to_a[i - 1] * (x[i] - x[i - 1]) + to_b[i] * (x[i] - x[i + b]) +
                 to_b[i - b] * (x[i] - x[i - b]) + to_c[i] * (x[i] - x[i + c]) + to_c[i - c] * (x[i] - x[i - c]);
  }
}

constexpr Index kShort = 1024;  // So many are in the nearest cache when they are needed again.

}  // namespace

template <typename Scalar>
double LineMatrix<Scalar>::multiply(const Values<Scalar>& x, Values<Scalar>& product) const {
  if (product.size() != x.size()) product.setZero(x.size());
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(stretch_count(x.size()));
  each_inner_stretch(*this, [&](Index begin, Index count, Index number) {
    for (Index at = begin; at < begin + count; at += kShort) {
      const Index entries = std::min(kShort, begin + count - at);
      stencil(*this, at, entries, x.data(), product.data());
      sums[number] += static_cast<double>(x.segment(at, entries).dot(product.segment(at, entries)));
    }
  });
  return sums.sum();
}

template <typename Scalar>
void LineMatrix<Scalar>::subtract(const Values<Scalar>& side, const Values<Scalar>& x, Values<Scalar>& rest) const {
  if (rest.size() != x.size()) rest.setZero(x.size());
  each_inner_stretch(*this, [&](Index begin, Index count, Index) {
    for (Index at = begin; at < begin + count; at += kShort) {
      const Index entries = std::min(kShort, begin + count - at);
      stencil(*this, at, entries, x.data(), rest.data());
      rest.segment(at, entries) = side.segment(at, entries) - rest.segment(at, entries);
    }
  });
}

LineLevels::LineLevels(const LineMatrix<double>& matrix) {
  LineMatrix<float>& finest = levels_.emplace_back().matrix;
  finest.extents = matrix.extents;
  finest.across = matrix.across.cast<float>();
  for (size_t axis = 0; axis < 3; ++axis) finest.weights[axis] = matrix.weights[axis].cast<float>();
  while (levels_.back().matrix.layer() > 1) {
    LineMatrix<float> coarse;
    const LineMatrix<float>& fine = levels_.back().matrix;
    coarse.extents = merge(fine.extents, kAcross);
    for (Values<float>& weights : coarse.weights) weights.setZero(coarse.extents.count());
    for (int axis = 0; axis < 2; ++axis) {
      const auto at = static_cast<size_t>(axis);
      gather_weights(fine.extents, kAcross, axis, fine.weights[at].data(), coarse.weights[at].data());
    }
    gather(fine.extents, kAcross, fine.weights[2].data(), coarse.weights[2].data());
    coarse.sum_across();
    levels_.emplace_back().matrix = std::move(coarse);
  }
  for (Level& level : levels_) factor(level.matrix, level.inverse_pivots);
}

LineWork LineLevels::work() const {
  LineWork work;
  work.ties.layer = levels_[0].matrix.layer();
  work.ties.count = levels_[0].matrix.extents[2];
  for (const Level& level : levels_) {
    LineLevelWork& own = work.levels.emplace_back();
    own.residual = own.error = own.image = Values<float>::Zero(level.matrix.extents.count());
  }
  start(work, true);
  return work;
}

void LineLevels::start(LineWork& work, bool loose) const {
  if (loose) work.ties.at_bound.assign(static_cast<size_t>(work.ties.layer * (work.ties.count - 1)), 0);
  work.tied = false;
  work.levels[0].along = levels_[0].matrix.weights[2];
  for (size_t l = 0; l < levels_.size(); ++l) {
    work.levels[l].inverse_pivots = levels_[l].inverse_pivots;
    if (l > 0) work.levels[l].matrix = levels_[l].matrix;
  }
}

void LineLevels::tie(LineWork& work) const {
  const bool tied = !work.ties.blocks.empty();
  if (!tied && !work.tied) return;
  work.tied = tied;
  tie_finest(work);
  stiffen(work);
}

void LineLevels::tie_finest(LineWork& work) const {
  const LineMatrix<float>& matrix = levels_[0].matrix;
  const Ties& ties = work.ties;
  Values<float>&along = work.levels[0].along, &inverse_pivots = work.levels[0].inverse_pivots;
  along = matrix.weights[2];
  inverse_pivots = levels_[0].inverse_pivots;
  const auto line_of = [&](size_t block) { return ties.blocks[block].first % ties.layer; };
  for (size_t block = 0; block < ties.blocks.size(); ++block) {
    const Index line = line_of(block);
    if (block > 0 && line == line_of(block - 1)) continue;
    float held = 0;
    for (Index at = line; at < line + (ties.count - 1) * ties.layer; at += ties.layer) {
      if (ties.at_bound[static_cast<size_t>(at)] != 0) along[at] += kTie * (matrix.across[at] + along[at]);
      if (at == line) {
        held = along[at];
        continue;
      }
      held += matrix.across[at];
      inverse_pivots[at] = 1 / (held + along[at]);
      held *= along[at] * inverse_pivots[at];
    }
  }
}

/// Makes the coarser levels' lines, with what holds those edges that are tied.
void LineLevels::stiffen(LineWork& work) const {
  const LineMatrix<float>& finest = levels_[0].matrix;
  work.levels[0].image.setZero();
  work.ties.each_block([&](const Ties::Block& block, const auto& vertex) {
    for (Index i = 0; i + 1 < block.count; ++i) {
      const Index at = vertex(i);
      work.levels[0].image[at] = kLinesHeld / 2 * (finest.diagonal(at) + finest.diagonal(vertex(i + 1)));
    }
  });
  for (size_t l = 1; l < levels_.size(); ++l) {
    LineLevelWork &fine = work.levels[l - 1], &coarse = work.levels[l];
    gather(levels_[l - 1].matrix.extents, kAcross, fine.image.data(), coarse.image.data());
    fine.image.setZero();
    coarse.matrix.weights[2] = levels_[l].matrix.weights[2] + coarse.image;
    factor(coarse.matrix, coarse.inverse_pivots);
  }
  work.levels.back().image.setZero();
}

void LineLevels::descend(size_t at, const Values<float>& residual, Values<float>& error, LineWork& work) const {
  LineLevelWork& own = work.levels[at];
  const LineMatrix<float>& matrix = at == 0 ? levels_[0].matrix : own.matrix;
  const Values<float>& along = at == 0 ? own.along : own.matrix.weights[2];
  solve_lines<false>(matrix.extents, along, own.inverse_pivots, residual, error);
  if (at + 1 == levels_.size()) return;
  if (at == 0) work.ties.keep(error);
  matrix.subtract(residual, error, own.image);
  if (at == 0) work.ties.keep(own.image);
  LineLevelWork& coarse = work.levels[at + 1];
  gather(matrix.extents, kAcross, own.image.data(), coarse.residual.data());
  descend_twice(at + 1, work);
  scatter_add(matrix.extents, kAcross, coarse.error.data(), error.data());
  if (at == 0) work.ties.keep(error);
  matrix.subtract(residual, error, own.image);
  if (at == 0) work.ties.keep(own.image);
  solve_lines<true>(matrix.extents, along, own.inverse_pivots, own.image, error);
  if (at == 0) work.ties.keep(error);
}

void LineLevels::descend_twice(size_t at, LineWork& work) const {
  LineLevelWork& own = work.levels[at];
  descend(at, own.residual, own.error, work);
  if (at > kLinesTwice || at + 1 == levels_.size()) return;
  join_twice(
      own.matrix, [&](const Values<float>& rest, Values<float>& more) { descend(at, rest, more, work); },
      [](const Values<float>&) {}, own.residual, own.error, own.twice);
}

void LineLevels::cycle(const Values<float>& residual, Values<float>& error, LineWork& work) const {
  if (error.size() != residual.size()) error.setZero(residual.size());
  descend(0, residual, error, work);
}

template struct LineMatrix<float>;
template struct LineMatrix<double>;

}  // namespace swage
