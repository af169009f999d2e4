#include "scales.h"

#include <algorithm>
#include <cmath>

#include "bounded.h"
#include "conjugate_gradients.h"
#include "pool.h"
#include "scale_levels.h"
#include "swage/error.h"

namespace swage {
namespace {

using Eigen::Index;
using Vector = Values<double>;

constexpr int kIterationLimit = 500;  // Of a round.
constexpr int kRoundLimit = 200;
constexpr double kRounding = 1e-14;
constexpr double kLoose = 1e-3;  // The tolerance while cells still come to the bound and leave it.

constexpr const char* kCaller = "ScaleSolve";

/// Scales are solved for as what they differ by from the plain scale: exactly nothing where it is best.
double least_change(double factor) { return kLeastScale * std::min(1.0, factor) - factor; }

ScaleMatrix<double> with_weights(const GridShape& shape, const Eigen::VectorXd& phi) {
  ScaleMatrix<double> matrix{ScaleLayout(shape.cells)};
  const ScaleLayout& layout = matrix.layout;
  matrix.neighbours.setZero(layout.size);
  matrix.diagonal.setZero(layout.size);
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
  explicit ScaleWork(const ScaleMatrix<double>& of) : matrix(of), levels(of) {}

  ScaleMatrix<double> matrix;
  ScaleLevels levels;
  GradientsWork<Vector> gradients;
  Vector side, change, image, free;
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
  Gradients improve(ScaleWork& work, const Eigen::RowVector3d& factors, double tolerance, double& first,
                    const Poll& poll) const;
  Eigen::ArrayXd measure(ScaleWork& work, const AtBound& at_bound, const Eigen::RowVector3d& factors) const;
  void hold(ScaleWork& work, const AtBound& at_bound, const Eigen::RowVector3d& factors) const;
  void pull_in(ScaleWork& work, const Eigen::RowVector3d& factors) const;
  template <typename Work>
  void each_row(const Work& work) const;
};

/// Calls work(axis, first cell of a row, stride along it).
template <typename Work>
void ScaleSolve::Plan::each_row(const Work& work) const {
  for (int u = 0; u < 3; ++u) {
    const Index stride = shape.cells.stride(u), rows = shape.cells.count() / shape.cells[u];
#pragma omp parallel for schedule(static) if (shape.cells.count() > kManyEntries)
    for (Index row = 0; row < rows; ++row) work(u, row / stride * stride * shape.cells[u] + row % stride, stride);
  }
}

void ScaleSolve::Plan::fill(ScaleWork& work, const Eigen::RowVector3d& factors, double unit, double size_weight) const {
  const ScaleLayout& layout = matrix.layout;
  ScaleMatrix<double>& own = work.matrix;
  work.side.setZero(layout.size);
  work.change.setZero(layout.size);
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
      own.pairs[static_cast<size_t>(u)][c] = weight * inverse[u] * inverse[v];
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
      own.diagonal[at] = own.neighbours[at] + diagonal[u] + size;
      work.side[at] = pull[u] + size * (1 - factors[u]);
    }
  }
  work.levels.fill(own);
}

/// Conjugate gradients to a part of the error that was there at first, at the first call.
Gradients ScaleSolve::Plan::improve(ScaleWork& work, const Eigen::RowVector3d& factors, double tolerance, double& first,
                                    const Poll& poll) const {
  const auto times_matrix = [&](const Vector& x, Vector& product) {
    ask(poll);
    work.matrix.multiply(x, product);
  };
  const auto precondition = [&](const Vector& residual, Vector& error) { work.levels.cycle(residual, error); };
  times_matrix(work.change, work.image);
  work.image = work.side - work.image;
  precondition(work.image, work.gradients.error);
  const double square = product(work.image, work.gradients.error);
  // What it would be if all scales were off by rounding: nothing is to be gained below.
  const double rounding = kRounding * kRounding * factors.squaredNorm() * work.matrix.diagonal.sum();
  if (first < 0) first = square;
  if (square <= std::max(tolerance * tolerance * first, rounding)) return {0, true};
  return conjugate_gradients(times_matrix, precondition, work.side, tolerance * std::sqrt(first / square),
                             kIterationLimit, work.change, work.gradients);
}

/// Of each entry at the bound its multiplier, of others how far they are from it.
Eigen::ArrayXd ScaleSolve::Plan::measure(ScaleWork& work, const AtBound& at_bound,
                                         const Eigen::RowVector3d& factors) const {
  const ScaleLayout& layout = matrix.layout;
  const Index count = shape.cells.count();
  Eigen::ArrayXd result(3 * count);
  work.matrix.multiply(work.change, work.image);
  work.image -= work.side;
  each_row([&](int u, Index cell, Index stride) {
    const Index at = layout.begins[static_cast<size_t>(u)] + cell, entry = u * count + cell;
    const double bound = least_change(factors[u]);
    double sum = 0, free = 0;
    for (Index i = 0; i < shape.cells[u]; ++i) {
      if (at_bound[static_cast<size_t>(entry + i * stride)] != 0) continue;
      sum += work.image[at + i * stride];
      free += 1;
    }
    for (Index i = 0; i < shape.cells[u]; ++i) {
      result[entry + i * stride] = at_bound[static_cast<size_t>(entry + i * stride)] != 0
                                       ? work.image[at + i * stride] - sum / free
                                       : work.change[at + i * stride] - bound;
    }
  });
  return result;
}

/// Puts scales to the bound, and what their rows lack onto those that are free.
void ScaleSolve::Plan::hold(ScaleWork& work, const AtBound& at_bound, const Eigen::RowVector3d& factors) const {
  const ScaleLayout& layout = matrix.layout;
  work.free.setZero(layout.size);
  each_row([&](int u, Index cell, Index stride) {
    const Index at = layout.begins[static_cast<size_t>(u)] + cell, entry = u * shape.cells.count() + cell;
    const double bound = least_change(factors[u]);
    double lack = 0, free = 0;
    for (Index i = 0; i < shape.cells[u]; ++i) {
      const bool held = at_bound[static_cast<size_t>(entry + i * stride)] != 0;
      if (held) work.change[at + i * stride] = bound;
      lack -= work.change[at + i * stride];
      work.free[at + i * stride] = held || !shape.extends(u) ? 0 : 1;
      free += held ? 0 : 1;
    }
    if (free == shape.cells[u] && std::abs(lack) <= 1e-12 * factors[u] * free) return;
    for (Index i = 0; i < shape.cells[u]; ++i) {
      if (at_bound[static_cast<size_t>(entry + i * stride)] == 0) work.change[at + i * stride] += lack / free;
    }
  });
  work.levels.hold(work.free, std::count(at_bound.begin(), at_bound.end(), 1) == 0);
}

/// Draws rows that pass the bound towards the uniform scale until they do not: what tolerances left.
void ScaleSolve::Plan::pull_in(ScaleWork& work, const Eigen::RowVector3d& factors) const {
  const ScaleLayout& layout = matrix.layout;
  each_row([&](int u, Index cell, Index stride) {
    const double bound = least_change(factors[u]);
    double* row = work.change.data() + layout.begins[static_cast<size_t>(u)] + cell;
    double part = 1;
    for (Index i = 0; i < shape.cells[u]; ++i) {
      if (row[i * stride] < bound) part = std::min(part, bound / row[i * stride]);
    }
    if (part == 1) return;
    for (Index i = 0; i < shape.cells[u]; ++i) {
      row[i * stride] = std::max(bound, part * row[i * stride]);
    }
  });
}

ScaleSolve::ScaleSolve(const GridShape& shape, const CellMap& map) {
  check(kCaller, shape, map);
  plan_.reset(new Plan{shape, map, with_weights(shape, map.phi)});
  plan_->works.lend([&] { return std::make_unique<ScaleWork>(plan_->matrix); });
}
ScaleSolve::~ScaleSolve() = default;
ScaleSolve::ScaleSolve(ScaleSolve&&) noexcept = default;
ScaleSolve& ScaleSolve::operator=(ScaleSolve&&) noexcept = default;

Scales ScaleSolve::solve(const Eigen::RowVector3d& given, const ScaleOptions& options, const Poll& poll) const {
  check_factors(kCaller, plan_->shape, given);
  if (!(options.size_weight >= 0 && std::isfinite(options.size_weight))) {
    throw InvalidInput("ScaleSolve: options.size_weight: not finite and at least 0");
  }
  if (!(options.tolerance > 0 && options.tolerance < 1))
    throw InvalidInput("ScaleSolve: options.tolerance: not in (0, 1)");
  Eigen::RowVector3d factors = given;
  for (int u = 0; u < 3; ++u) factors[u] = plan_->shape.extends(u) ? given[u] : 1;
  const auto work = plan_->works.lend([&] { return std::make_unique<ScaleWork>(plan_->matrix); });
  const Index count = plan_->shape.cells.count();

  // Vulnerable cells that are to keep their size are to have the scale 1, whatever the factors.
  plan_->fill(*work, factors, options.size_weight > 0 ? 1 : unit_scale(plan_->shape, factors), options.size_weight);
  AtBound at_bound(static_cast<size_t>(3 * count), 0);
  BlockPivoting pivoting;
  Scales result;
  double first = -1, tolerance = std::max(kLoose, options.tolerance);
  while (true) {
    plan_->hold(*work, at_bound, factors);
    const Gradients gradients = plan_->improve(*work, factors, tolerance, first, poll);
    result.iterations += gradients.iterations;
    result.converged = gradients.converged && result.rounds < kRoundLimit;
    const double negligible = 10 * tolerance * std::min(1.0, factors.minCoeff()) * kLeastScale;
    if (!pivoting.exchange(plan_->measure(*work, at_bound, factors), negligible, at_bound)) {
      if (tolerance <= options.tolerance) break;
      tolerance = options.tolerance;
      continue;
    }
    if (result.rounds++ == kRoundLimit) break;
  }
  plan_->pull_in(*work, factors);
  result.at_bound = std::count(at_bound.begin(), at_bound.end(), 1);
  result.values.resize(count, 3);
  for (int u = 0; u < 3; ++u) {
    result.values.col(u) =
        work->change.segment(plan_->matrix.layout.begins[static_cast<size_t>(u)], count).array() + factors[u];
  }
  return result;
}

}  // namespace swage
