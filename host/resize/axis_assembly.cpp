#include "axis_assembly.h"

#include <algorithm>
#include <cmath>

#include "assemble.h"

namespace swage {
namespace {

using Eigen::Index;
using Vector = Values<double>;

constexpr int kIterationLimit = 500;  // Of a round.
constexpr int kRoundLimit = 200;
constexpr double kLoose = 1e-3;  // The tolerance while edges still come to the bound and leave it.
constexpr double kRounding = 1e-14;

/// Adds each cell's value to the four edges along `axis` that bound it, told by their first vertices.
void add_to_edges(const TurnedGrid& grid, int axis, const Vector& cells, Vector& edges) {
  const Extents& count = grid.cells;
  const Index a = grid.vertices.stride(next(axis)), b = grid.vertices.stride(next(next(axis)));
  for (int k = 0; k < count[2]; ++k) {
    for (int j = 0; j < count[1]; ++j) {
      for (int i = 0; i < count[0]; ++i) {
        const Index first = grid.vertices.at(i, j, k);
        const double value = cells[count.at(i, j, k)];
        for (const Index at : {first, first + a, first + b, first + a + b}) edges[at] += value;
      }
    }
  }
}

Vector turned(const TurnedGrid& grid, const Eigen::VectorXd& values) {
  Vector result(values.size());
  Extents cells = grid.cells;  // As they were.
  for (int axis = 0; axis < 3; ++axis) cells[(axis + grid.axis + 1) % 3] = grid.cells[axis];
  Index c = 0;
  for (int k = 0; k < cells[2]; ++k) {
    for (int j = 0; j < cells[1]; ++j) {
      for (int i = 0; i < cells[0]; ++i) result[grid.cell(i, j, k)] = values[c++];
    }
  }
  return result;
}

LineMatrix<double> matrix_of(const TurnedGrid& grid, const Vector& theta, const Vector& phi) {
  LineMatrix<double> matrix;
  matrix.extents = grid.vertices;
  for (int axis = 0; axis < 3; ++axis) {
    Vector& weights = matrix.weights[static_cast<size_t>(axis)];
    weights.setZero(grid.vertices.count());
    add_to_edges(grid, axis, axis == 2 ? theta : phi, weights);
  }
  matrix.sum_diagonal();
  return matrix;
}

}  // namespace

TurnedGrid::TurnedGrid(const Extents& of_cells, int u) : axis(u), cells(of_cells), vertices(of_cells) {
  for (int a = 0; a < 3; ++a) {
    cells[a] = of_cells[(a + u + 1) % 3];
    vertices[a] = cells[a] + 1;
  }
}

Index TurnedGrid::turned(const Extents& extents, int i, int j, int k) const {
  const std::array<int, 3> at = {i, j, k};
  const auto along = [&](int a) { return at[static_cast<size_t>((a + axis + 1) % 3)]; };
  return extents.at(along(0), along(1), along(2));
}

AxisAssembly::AxisAssembly(const Extents& cells, const CellMap& map, int u)
    : grid_(cells, u),
      theta_(turned(grid_, map.theta.col(u).cwiseMax(kLeastVulnerability))),
      matrix_(matrix_of(grid_, theta_, turned(grid_, kOrthogonality * map.phi))),
      levels_(matrix_) {}

void AxisAssembly::pull(const Eigen::VectorXd& scales, double factor, AxisWork& work) const {
  Vector edges = Vector::Zero(grid_.vertices.count());
  add_to_edges(grid_, 2, theta_.cwiseProduct(turned(grid_, scales.array() - factor)), edges);
  const Index layer = matrix_.layer(), inner = edges.size() - 2 * layer;
  work.side.setZero(edges.size());
  work.side.segment(layer, inner) = edges.head(inner) - edges.segment(layer, inner);
}

/// Brings tied vertices as far apart as edges at the bound are long, about where they were.
void AxisAssembly::tie(double least, AxisWork& work) const {
  Ties& ties = work.levels.ties;
  ties.find_lines();
  for (const Index line : ties.lines) {
    ties.each_block(line, [&](Index first, Index last) {
      const auto at = [&](Index i) -> double& { return work.change[line + i * ties.layer]; };
      double offset = 0;
      for (Index i = first; i <= last; ++i) offset += at(i) - least * static_cast<double>(i - first);
      offset /= static_cast<double>(last - first + 1);
      if (first == 0) offset = 0;
      if (last == ties.count - 1) offset = -least * static_cast<double>(last - first);
      for (Index i = first; i <= last; ++i) at(i) = offset + least * static_cast<double>(i - first);
    });
  }
  levels_.tie(work.levels);
}

Gradients AxisAssembly::improve(double factor, double tolerance, const Poll& poll, AxisWork& work) const {
  const Ties& ties = work.levels.ties;
  const auto times_matrix = [&](const Vector& x, Vector& product) {
    ask(poll);
    matrix_.multiply(x, product);
    ties.keep(product);
  };
  const auto precondition = [&](const Vector& residual, Vector& error) {
    levels_.cycle(residual, error, work.levels);
    ties.keep(error);
  };
  Vector side = work.side;
  ties.keep(side);
  times_matrix(work.change, work.image);
  work.image = side - work.image;
  precondition(work.image, work.gradients.error);
  const double square = product(work.image, work.gradients.error);
  // What it would be if all vertices were off by rounding: nothing is to be gained below.
  const double off = kRounding * factor * grid_.cells[2];
  if (work.first_square < 0) work.first_square = square;
  const double first = work.first_square;
  if (square <= std::max(tolerance * tolerance * first, off * off * matrix_.diagonal.sum())) return {0, true};
  return conjugate_gradients(times_matrix, precondition, side, tolerance * std::sqrt(first / square), kIterationLimit,
                             work.change, work.gradients);
}

/// Of each edge at the bound its multiplier, of others how far they are from it. Edges are told by their first vertex.
Eigen::ArrayXd AxisAssembly::measure(double least, AxisWork& work) const {
  const Ties& ties = work.levels.ties;
  const Index layer = ties.layer, edges = layer * (ties.count - 1);
  Eigen::ArrayXd result = work.change.segment(layer, edges).array() - work.change.head(edges).array() - least;
  if (ties.lines.empty()) return result;
  matrix_.multiply(work.change, work.image);
  work.image -= work.side;
  for (const Index line : ties.lines) {
    const auto slope = [&](Index i) { return work.image[line + i * layer]; };
    ties.each_block(line, [&](Index first, Index last) {
      double multiplier = 0;
      if (first > 0) {
        for (Index i = first; i < last; ++i) result[line + i * layer] = multiplier -= slope(i);
      } else {  // The first vertex is held by the outer face as well.
        for (Index i = last; i > first; --i) result[line + (i - 1) * layer] = multiplier += slope(i);
      }
    });
  }
  return result;
}

/// Draws lines that pass the bound towards plain scaling until they do not: what tolerances left.
void AxisAssembly::pull_in(double least, AxisWork& work) const {
  const Index layer = matrix_.layer();
#pragma omp parallel for schedule(static) if (work.change.size() > kManyEntries)
  for (Index line = 0; line < layer; ++line) {
    double part = 1;
    for (Index i = 0; i + 1 < grid_.vertices[2]; ++i) {
      const double edge = work.change[line + (i + 1) * layer] - work.change[line + i * layer];
      if (edge < least) part = std::min(part, least / edge);
    }
    if (part == 1) continue;
    for (Index i = 0; i < grid_.vertices[2]; ++i) work.change[line + i * layer] *= part;
  }
}

AxisResult AxisAssembly::solve(const Eigen::VectorXd& scales, double factor, double tolerance, bool again,
                               const Poll& poll, AxisWork& work) const {
  pull(scales, factor, work);
  if (!again) {
    work.change.setZero(work.side.size());
    work.levels.ties.at_bound.assign(static_cast<size_t>(matrix_.layer() * grid_.cells[2]), 0);
    work.first_square = -1;
  }
  const double bound = kLeastEdge * std::min(1.0, factor), least = bound - factor;
  BlockPivoting pivoting;
  AxisResult result;
  double now = std::max(kLoose, tolerance);
  while (true) {
    tie(least, work);
    const Gradients gradients = improve(factor, now, poll, work);
    result.iterations += gradients.iterations;
    result.converged = gradients.converged && result.rounds < kRoundLimit;
    if (!pivoting.exchange(measure(least, work), 10 * now * bound, work.levels.ties.at_bound)) {
      if (now <= tolerance) break;
      now = tolerance;
      continue;
    }
    if (result.rounds++ == kRoundLimit) break;
  }
  pull_in(least, work);
  result.at_bound = std::count(work.levels.ties.at_bound.begin(), work.levels.ties.at_bound.end(), 1);
  return result;
}

}  // namespace swage
