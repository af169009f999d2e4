#include "line_levels.h"

#include <algorithm>

#include "vectors.h"

namespace swage {
namespace {

using Eigen::Index;

constexpr float kDamping = 0.9F;
constexpr float kTie = 1000;  // How much stronger than all else vertices are tied, in the lines that smooth.
constexpr Merged kAcross = {true, true, false};

template <typename Scalar>
auto part(const Values<Scalar>& values, Index begin, Index count) {
  return values.segment(begin, count).array();
}

}  // namespace

template <typename Scalar>
void LineMatrix<Scalar>::sum_diagonal() {
  diagonal.setZero(extents.count());
  for (int axis = 0; axis < 3; ++axis) {
    const Index stride = extents.stride(axis), count = extents.count() - stride;
    const Values<Scalar>& own = weights[static_cast<size_t>(axis)];
    diagonal += own;
    diagonal.tail(count) += own.head(count);
  }
}

template <typename Scalar>
void LineMatrix<Scalar>::multiply(const Values<Scalar>& x, Values<Scalar>& product) const {
  if (product.size() != x.size()) product.setZero(x.size());
  const Index a = 1, b = extents.stride(1), c = layer();
  each_stretch(std::max(x.size() - 2 * c, Index{0}), [&](Index begin, Index count, Index) {
    const Index at = c + begin;
    product.segment(at, count).array() =
        part(diagonal, at, count) * part(x, at, count) - part(weights[0], at, count) * part(x, at + a, count) -
        part(weights[0], at - a, count) * part(x, at - a, count) -
        part(weights[1], at, count) * part(x, at + b, count) -
        part(weights[1], at - b, count) * part(x, at - b, count) -
        part(weights[2], at, count) * part(x, at + c, count) - part(weights[2], at - c, count) * part(x, at - c, count);
  });
}

void LineLevels::Level::factor() {
  const Index layer = matrix.layer();
  lines.weights = matrix.weights[2];
  lines.inverse_pivots.setZero(matrix.extents.count());
  for (Index i = 1; i + 1 < matrix.extents[2]; ++i) {
    const auto before = part(lines.weights, (i - 1) * layer, layer);
    lines.inverse_pivots.segment(i * layer, layer).array() =
        1.0F / (part(matrix.diagonal, i * layer, layer) -
                before * before * part(lines.inverse_pivots, (i - 1) * layer, layer));
  }
}

void LineLevels::tie(LineWork& work) const {
  const LineMatrix<float>& matrix = levels_[0].matrix;
  const Ties& ties = work.ties;
  work.finest = levels_[0].lines;
  Values<float>&weights = work.finest.weights, &inverse_pivots = work.finest.inverse_pivots;
#pragma omp parallel for schedule(static) if (static_cast <Index>(ties.lines.size()) * ties.count > kManyEntries)
  for (const Index line : ties.lines) {
    const auto extra = [&](Index i) {
      const Index at = line + i * ties.layer;
      return ties.at_bound[static_cast<size_t>(at)] == 0 ? 0 : kTie * (matrix.diagonal[at] + matrix.weights[2][at]);
    };
    for (Index i = 0; i + 1 < ties.count; ++i) {
      const Index at = line + i * ties.layer, before = at - ties.layer;
      weights[at] += extra(i);
      if (i == 0) continue;
      inverse_pivots[at] = 1.0F / (matrix.diagonal[at] + extra(i) + extra(i - 1) -
                                   weights[before] * weights[before] * inverse_pivots[before]);
    }
  }
}

void LineLevels::Level::solve_lines(const LineFactor& factor, Values<float>& sides) const {
  constexpr Index kSide = 256;
  const Index layer = matrix.layer(), last = matrix.extents[2] - 2;
  const Values<float>&weights = factor.weights, &inverse_pivots = factor.inverse_pivots;
#pragma omp parallel for schedule(static) if (matrix.extents.count() > kManyEntries)
  for (Index begin = 0; begin < layer; begin += kSide) {
    const Index count = std::min(kSide, layer - begin);
    for (Index i = 1; i <= last; ++i) {
      const Index at = i * layer + begin, before = at - layer;
      auto own = sides.segment(at, count).array();
      if (i == 1) {
        own *= part(inverse_pivots, at, count);
      } else {
        own = (own + part(weights, before, count) * part(sides, before, count)) * part(inverse_pivots, at, count);
      }
    }
    for (Index i = last - 1; i >= 1; --i) {
      const Index at = i * layer + begin, after = at + layer;
      sides.segment(at, count).array() +=
          part(weights, at, count) * part(inverse_pivots, at, count) * part(sides, after, count);
    }
  }
}

LineLevels::LineLevels(const LineMatrix<double>& matrix) {
  LineMatrix<float>& finest = levels_.emplace_back().matrix;
  finest.extents = matrix.extents;
  finest.diagonal = matrix.diagonal.cast<float>();
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
    coarse.sum_diagonal();
    levels_.emplace_back().matrix = std::move(coarse);
  }
  for (Level& level : levels_) level.factor();
}

LineWork LineLevels::work() const {
  LineWork work;
  work.ties.layer = levels_[0].matrix.layer();
  work.ties.count = levels_[0].matrix.extents[2];
  for (const Level& level : levels_) {
    const Values<float> zero = Values<float>::Zero(level.matrix.extents.count());
    work.levels.push_back({zero, zero, zero});
  }
  return work;
}

void LineLevels::descend(size_t at, LineWork& work) const {
  const Level& level = levels_[at];
  const LineFactor& lines = at == 0 ? work.finest : level.lines;
  auto& [residual, error, image] = work.levels[at];
  error = residual;
  level.solve_lines(lines, error);
  if (at + 1 == levels_.size()) return;
  error *= kDamping;
  if (at == 0) work.ties.keep(error);
  level.matrix.multiply(error, image);
  combine(1, residual, -1, image);
  if (at == 0) work.ties.keep(image);
  LineWork::Level& coarse = work.levels[at + 1];
  gather(level.matrix.extents, kAcross, image.data(), coarse.residual.data());
  descend(at + 1, work);
  scatter_add(level.matrix.extents, kAcross, coarse.error.data(), error.data());
  if (at == 0) work.ties.keep(error);
  level.matrix.multiply(error, image);
  combine(1, residual, -1, image);
  if (at == 0) work.ties.keep(image);
  level.solve_lines(lines, image);
  combine(kDamping, image, 1, error);
}

void LineLevels::cycle(const Values<double>& residual, Values<double>& error, LineWork& work) const {
  work.levels[0].residual = residual.cast<float>();
  descend(0, work);
  error = work.levels[0].error.cast<double>();
}

template struct LineMatrix<float>;
template struct LineMatrix<double>;

}  // namespace swage
