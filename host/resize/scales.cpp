#include "scales.h"

#include <algorithm>
#include <cmath>

#include "bounded.h"
#include "correction.h"
#include "messages.h"
#include "pool.h"
#include "scale_levels.h"
#include "swage/error.h"

namespace swage {
namespace {

using Eigen::Index;
using Vector = Values<double>;
using Side = Eigen::Array<double, Eigen::Dynamic, 1, 0, kSide, 1>;

constexpr int kScaleIterationLimit = 50;  // Of a round.
constexpr int kScaleRoundLimit = 200;
constexpr double kScaleRounding = 1e-14;

constexpr const char* kScaleSolve = "ScaleSolve";

/// Scales are solved for as what they differ by from the plain scale: exactly nothing where it is best.
double least_change(double factor) { return kLeastScale * std::min(1.0, factor) - factor; }

ScaleMatrix<double> with_weights(const GridShape& shape, const Eigen::VectorXd& phi) {
  ScaleMatrix<double> matrix{ScaleLayout(shape.cells)};
  const ScaleLayout& layout = matrix.layout;
  matrix.neighbours.setZero(layout.size);
  matrix.own.setZero(layout.size);
  for (Vector& weights : matrix.weights) weights.setZero(layout.size);
  for (Vector& pair : matrix.pairs) pair.setZero(shape.cells.count());
  for (int u = 0; u < 3; ++u) {
    if (!shape.extends(u)) continue;
    const Index begin = layout.begins[static_cast<size_t>(u)];
    for (size_t side = 0; side < 2; ++side) {
      const int v = side == 0 ? next(u) : next(next(u));
      const Index stride = shape.cells.stride(v);
      for (Index c = 0; c < phi.size(); ++c) {
        if (c / stride % shape.cells[v] == shape.cells[v] - 1) continue;
        const double weight = kCompatibility * phi[c] * phi[c + stride];
        matrix.weights[side][begin + c] = weight;
        matrix.neighbours[begin + c] += weight;
        matrix.neighbours[begin + c + stride] += weight;
      }
    }
  }
  return matrix;
}

/// What one thread at a time works with.
struct ScaleWork {
  explicit ScaleWork(const ScaleMatrix<double>& of)
      : matrix(of),
        levels(of),
        side(Vector::Zero(of.layout.size)),
        measure(Eigen::ArrayXd::Zero(of.layout.size)),
        free(Values<float>::Zero(of.layout.size)) {}

  ScaleMatrix<double> matrix;
  ScaleLevels levels;
  CorrectionWork correction;
  Vector side, change, rest;  // Rest: what the change leaves of the side.
  Eigen::ArrayXd measure;
  Values<float> free;
  AtBound at_bound;  // As long as the vectors are.
};

}  // namespace

double unit_scale(const GridShape& shape, const Eigen::RowVector3d& factors) {
  double least = INFINITY, most = 0;
  for (int u = 0; u < 3; ++u) {
    if (!shape.extends(u)) continue;
    least = std::min(least, factors[u]);
    most = std::max(most, factors[u]);
  }
  return least <= most ? std::clamp(1.0, least, most) : 1;
}

struct ScaleSolve::Plan {
  GridShape shape;
  CellMap map;
  ScaleMatrix<double> matrix;
  Pool<ScaleWork> works = {};

  void fill(ScaleWork& work, const Eigen::RowVector3d& factors, double unit, double size_weight) const;
  void hold(ScaleWork& work, const Eigen::RowVector3d& factors) const;
  Correction improve(ScaleWork& work, Approach& approach, const Poll& poll) const;
  void measure(ScaleWork& work, const Eigen::RowVector3d& factors, const Approach& approach) const;
  void pull_in(ScaleWork& work, const Eigen::RowVector3d& factors) const;
  template <typename Work>
  void each_axis(const Work& work) const;
};

/// Calls work(axis, length, begin, count, stride): that many rows along the axis side by side.
template <typename Work>
void ScaleSolve::Plan::each_axis(const Work& work) const {
#pragma omp parallel if (matrix.layout.large())
  for (int u = 0; u < 3; ++u) {
    each_rows(matrix.layout, u,
              [&](Index begin, Index count, Index stride, Index) { work(u, shape.cells[u], begin, count, stride); });
  }
}

void ScaleSolve::Plan::fill(ScaleWork& work, const Eigen::RowVector3d& factors, double unit, double size_weight) const {
  const ScaleLayout& layout = matrix.layout;
  work.change.setZero(layout.size);
  work.at_bound.assign(static_cast<size_t>(layout.size), 0);
#pragma omp parallel for schedule(static) if (shape.cells.count() > kManyEntries)
  for (Index c = 0; c < shape.cells.count(); ++c) {
    Eigen::RowVector3d inverse = Eigen::RowVector3d::Zero(), diagonal = Eigen::RowVector3d::Zero();
    for (int u = 0; u < 3; ++u) {
      if (!shape.extends(u)) continue;
      // So written that it is exact where S is the unit.
      inverse[u] = 1 / (unit + (1 - map.theta(c, u)) * (factors[u] - unit));
    }
    Eigen::RowVector3d pull = Eigen::RowVector3d::Zero();
    for (int u = 0; u < 3; ++u) {
      const int v = next(u);
      const double weight = std::max(std::min(map.theta(c, u), map.theta(c, v)), kLeastModulation);
      work.matrix.pairs[static_cast<size_t>(u)][c] = weight * inverse[u] * inverse[v];
      if (inverse[u] == 0 || inverse[v] == 0) continue;
      diagonal[u] += weight * inverse[u] * inverse[u];
      diagonal[v] += weight * inverse[v] * inverse[v];
      const double apart = weight * (factors[u] * inverse[u] - factors[v] * inverse[v]);
      pull[u] -= apart * inverse[u];
      pull[v] += apart * inverse[v];
    }
    for (int u = 0; u < 3; ++u) {
      const Index at = layout.begins[static_cast<size_t>(u)] + c;
      const double size = shape.extends(u) ? size_weight * map.theta(c, u) : 0;
      work.matrix.own[at] = diagonal[u] + size;
      work.side[at] = pull[u] + size * (1 - factors[u]);
    }
  }
  work.levels.fill(work.matrix);
}

/// Puts scales to the bound, and what their rows lack onto those that are free.
void ScaleSolve::Plan::hold(ScaleWork& work, const Eigen::RowVector3d& factors) const {
  each_axis([&](int u, int length, Index begin, Index count, Index stride) {
    const double bound = least_change(factors[u]);
    Side lack = Side::Zero(count), free = Side::Zero(count);
    for (Index i = 0; i < length; ++i) {
      for (Index r = 0; r < count; ++r) {
        const Index at = begin + i * stride + r;
        const bool held = work.at_bound[static_cast<size_t>(at)] != 0;
        if (held) work.change[at] = bound;
        lack[r] -= work.change[at];
        free[r] += held ? 0 : 1;
        work.free[at] = held || !shape.extends(u) ? 0 : 1;
      }
    }
    lack /= free;
    for (Index i = 0; i < length; ++i) {
      work.change.segment(begin + i * stride, count).array() +=
          lack * work.free.segment(begin + i * stride, count).array().cast<double>();
    }
  });
  work.matrix.subtract(work.side, work.change, work.rest);
  work.levels.hold(work.free, std::count(work.at_bound.begin(), work.at_bound.end(), 1) == 0);
}

Correction ScaleSolve::Plan::improve(ScaleWork& work, Approach& approach, const Poll& poll) const {
  const auto times_matrix = [&](const Values<float>& x, Values<float>& product) {
    ask(poll);
    const double bend = work.levels.finest().multiply(x, product);
    work.levels.rows().center(product, product);
    return bend;
  };
  const auto precondition = [&](const Values<float>& residual, Values<float>& error) {
    work.levels.cycle(residual, error);
  };
  const Rows rows = work.levels.rows();
  rows.center(work.rest, work.correction.residual);
  const Correction correction = correct(
      times_matrix, precondition, [&](double square) { return approach.enough(square); }, kScaleIterationLimit,
      work.correction);
  rows.add(work.correction.change, work.change);
  work.matrix.subtract(work.side, work.change, work.rest);
  return correction;
}

/// Of each entry at the bound its multiplier, of others how far they are from it; as parts of what may be off.
void ScaleSolve::Plan::measure(ScaleWork& work, const Eigen::RowVector3d& factors, const Approach& approach) const {
  Eigen::RowVector3d off;
  for (int u = 0; u < 3; ++u) {
    const auto error = work.correction.error.segment(matrix.layout.begins[static_cast<size_t>(u)], map.phi.size());
    off[u] = error.cwiseAbs().maxCoeff();
  }
  each_axis([&](int u, int length, Index begin, Index count, Index stride) {
    const double bound = least_change(factors[u]);
    Side mean = Side::Zero(count), free = Side::Zero(count);
    for (Index i = 0; i < length; ++i) {
      const auto own = work.free.segment(begin + i * stride, count).array().cast<double>();
      mean += own * work.rest.segment(begin + i * stride, count).array();
      free += own;
    }
    mean /= free.max(1);
    for (Index i = 0; i < length; ++i) {
      for (Index r = 0; r < count; ++r) {
        const Index at = begin + i * stride + r;
        const double diagonal = work.matrix.own[at] + work.matrix.neighbours[at];
        const double way = work.at_bound[static_cast<size_t>(at)] != 0 ? (mean[r] - work.rest[at]) / diagonal
                                                                       : work.change[at] - bound;
        work.measure[at] = way / std::max(off[u], approach.negligible(diagonal));
      }
    }
  });
}

/// Brings scales that tolerances left below the bound to it, at the cost of those above it.
void ScaleSolve::Plan::pull_in(ScaleWork& work, const Eigen::RowVector3d& factors) const {
  each_axis([&](int u, int length, Index begin, Index count, Index stride) {
    const double bound = least_change(factors[u]);
    Side below = Side::Zero(count), above = Side::Zero(count);
    for (Index i = 0; i < length; ++i) {
      const auto way = work.change.segment(begin + i * stride, count).array() - bound;
      below -= way.min(0);
      above += way.max(0);
    }
    if ((below == 0).all()) return;
    for (Index i = 0; i < length; ++i) {
      auto change = work.change.segment(begin + i * stride, count).array();
      change = (below > 0).select(bound + (change - bound).max(0) * (1 - below / above), change);
    }
  });
}

ScaleSolve::ScaleSolve(const GridShape& shape, const CellMap& map) {
  check(kScaleSolve, shape, map);
  plan_.reset(new Plan{shape, map, with_weights(shape, map.phi)});
  plan_->works.lend([&] { return std::make_unique<ScaleWork>(plan_->matrix); });
}
ScaleSolve::~ScaleSolve() = default;
ScaleSolve::ScaleSolve(ScaleSolve&&) noexcept = default;
ScaleSolve& ScaleSolve::operator=(ScaleSolve&&) noexcept = default;

Scales ScaleSolve::solve(const Eigen::RowVector3d& given, const ScaleOptions& options, const Poll& poll) const {
  check_factors(kScaleSolve, plan_->shape, given);
  if (!(options.size_weight >= 0 && std::isfinite(options.size_weight))) {
    throw InvalidInput("ScaleSolve: options.size_weight: " + digits(options.size_weight) +
                       " is not finite and at least 0");
  }
  if (!(options.tolerance > 0 && options.tolerance < 1))
    throw InvalidInput("ScaleSolve: options.tolerance: " + digits(options.tolerance) + " is not in (0, 1)");
  Eigen::RowVector3d factors = given;
  for (int u = 0; u < 3; ++u) factors[u] = plan_->shape.extends(u) ? given[u] : 1;
  const auto work = plan_->works.lend([&] { return std::make_unique<ScaleWork>(plan_->matrix); });
  const Index count = plan_->shape.cells.count();

  // Vulnerable cells that are to keep their size are to have the scale 1, whatever the factors.
  plan_->fill(*work, factors, options.size_weight > 0 ? 1 : unit_scale(plan_->shape, factors), options.size_weight);
  const double rounding =
      kScaleRounding * kScaleRounding * factors.squaredNorm() * (work->matrix.own + work->matrix.neighbours).sum();
  Approach approach(options.tolerance, rounding);
  BlockPivoting pivoting;
  Scales result;
  for (bool changed = true; true;) {
    if (changed) plan_->hold(*work, factors);
    const Correction correction = plan_->improve(*work, approach, poll);
    result.iterations += correction.iterations;
    result.converged = approach.there(correction);
    plan_->measure(*work, factors, approach);
    changed = pivoting.exchange(work->measure, 1, work->at_bound);
    if (!changed && (result.converged || !correction.gained())) break;
    result.converged = false;
    if (changed && result.rounds++ == kScaleRoundLimit) break;
    if (pivoting.stalled() && approach.tighten()) pivoting = {};  // It may be what solves leave that goes round.
  }
  plan_->pull_in(*work, factors);
  result.at_bound = std::count(work->at_bound.begin(), work->at_bound.end(), 1);
  result.values.resize(count, 3);
  for (int u = 0; u < 3; ++u) {
    result.values.col(u) =
        work->change.segment(plan_->matrix.layout.begins[static_cast<size_t>(u)], count).array() + factors[u];
  }
  return result;
}

}  // namespace swage
