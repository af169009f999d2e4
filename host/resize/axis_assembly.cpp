#include "axis_assembly.h"

#include <algorithm>
#include <cmath>

#include "assemble.h"

namespace swage {
namespace {

using Eigen::Index;
using Vector = Values<double>;

constexpr int kAxisIterationLimit = 50;  // Of a round.
constexpr int kAxisRoundLimit = 60;
constexpr double kAxisRounding = 1e-14;

/// Adds each cell's value to the four edges along `axis` that bound it, told by their first vertices.
void add_to_edges(const TurnedGrid& grid, int axis, const Vector& cells, Vector& edges) {
  const Extents& count = grid.cells;
  const Index a = grid.vertices.stride(next(axis)), b = grid.vertices.stride(next(next(axis)));
  for (int parity = 0; parity < 2; ++parity) {  // Layers that share no edge.
#pragma omp parallel for schedule(static) if (cells.size() > kManyEntries)
    for (int k = parity; k < count[2]; k += 2) {
      for (int j = 0; j < count[1]; ++j) {
        const Index first = grid.vertices.at(0, j, k);
        const auto row = cells.segment(count.at(0, j, k), count[0]);
        for (const Index at : {first, first + a, first + b, first + a + b}) edges.segment(at, count[0]) += row;
      }
    }
  }
}

Vector turned(const TurnedGrid& grid, const Eigen::VectorXd& values) {
  Vector result(values.size());
  Extents cells = grid.cells;  // As they were.
  for (int axis = 0; axis < 3; ++axis) cells[(axis + grid.axis + 1) % 3] = grid.cells[axis];
#pragma omp parallel for schedule(static) if (values.size() > kManyEntries)
  for (int k = 0; k < cells[2]; ++k) {
    for (int j = 0; j < cells[1]; ++j) {
      const Index first = grid.cell(0, j, k), stride = cells[0] > 1 ? grid.cell(1, j, k) - first : 1;
      for (int i = 0; i < cells[0]; ++i) result[first + i * stride] = values[cells.at(i, j, k)];
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
  matrix.sum_across();
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
  ties.find_blocks();
  ties.each_block([&](const Ties::Block& block, const auto& vertex) {
    double offset = 0;
    for (Index i = 0; i < block.count; ++i) offset += work.change[vertex(i)] - least * static_cast<double>(i);
    offset /= static_cast<double>(block.count);
    if (block.low) offset = 0;
    if (block.high) offset = -least * static_cast<double>(block.count - 1);
    for (Index i = 0; i < block.count; ++i) work.change[vertex(i)] = offset + least * static_cast<double>(i);
  });
  levels_.tie(work.levels);
  matrix_.subtract(work.side, work.change, work.rest);
}

Correction AxisAssembly::improve(Approach& approach, const Poll& poll, AxisWork& work) const {
  const Ties& ties = work.levels.ties;
  const auto times_matrix = [&](const Values<float>& x, Values<float>& product) {
    ask(poll);
    const double bend = levels_.finest().multiply(x, product);
    ties.keep(product);
    return bend;
  };
  const auto precondition = [&](const Values<float>& residual, Values<float>& error) {
    levels_.cycle(residual, error, work.levels);
  };
  work.kept = work.rest;
  ties.keep(work.kept);
  work.correction.residual = work.kept.cast<float>();
  const Correction correction = correct(
      times_matrix, precondition, [&](double square) { return approach.enough(square); }, kAxisIterationLimit,
      work.correction);
  work.change += work.correction.change.cast<double>();
  matrix_.subtract(work.side, work.change, work.rest);
  return correction;
}

/// Of each edge at the bound its multiplier, of others how far they are from it; as parts of what may be off. Edges are
/// told by their first vertex.
void AxisAssembly::measure(double least, const Approach& approach, AxisWork& work) const {
  const Ties& ties = work.levels.ties;
  const Index layer = ties.layer, edges = layer * (ties.count - 1);
  const Values<float>& error = work.correction.error;
  const double off = (error.tail(edges) - error.head(edges)).cwiseAbs().maxCoeff();
  const auto change = work.change.array();
  work.measure = (change.tail(edges) - change.head(edges) - least) /
                 (approach.negligible(1) / matrix_.weights[2].head(edges).array().sqrt()).max(off);
  ties.each_block([&](const Ties::Block& block, const auto& vertex) {
    double multiplier = 0;
    const auto put = [&](Index edge) {
      const double weight = 0.5 * (matrix_.diagonal(edge) + matrix_.diagonal(edge + layer));
      const double negligible = std::max(weight * off, approach.negligible(1) * std::sqrt(matrix_.weights[2][edge]));
      work.measure[edge] = multiplier / negligible;
    };
    if (!block.low) {
      for (Index i = 0; i + 1 < block.count; ++i) {
        multiplier += work.rest[vertex(i)];
        put(vertex(i));
      }
    } else {  // The first vertex is held by the outer face as well.
      for (Index i = block.count - 1; i > 0; --i) {
        multiplier -= work.rest[vertex(i)];
        put(vertex(i - 1));
      }
    }
  });
}

/// Brings edges that tolerances left below the bound to it, at the cost of the others of their lines.
void AxisAssembly::pull_in(double least, AxisWork& work) const {
  const Index layer = matrix_.layer();
#pragma omp parallel for schedule(static) if (work.change.size() > kManyEntries)
  for (Index line = 0; line < layer; ++line) {
    const auto change = [&](Index i) -> double& { return work.change[line + i * layer]; };
    double below = 0, above = 0;
    for (Index i = 0; i + 1 < grid_.vertices[2]; ++i) {
      const double way = change(i + 1) - change(i) - least;
      (way < 0 ? below : above) += std::abs(way);
    }
    if (below == 0) continue;
    double before = change(0);
    for (Index i = 0; i + 2 < grid_.vertices[2]; ++i) {
      const double way = change(i + 1) - before - least;
      before = change(i + 1);
      change(i + 1) = change(i) + least + std::max(way, 0.0) * (1 - below / above);
    }
  }
}

AxisResult AxisAssembly::solve(const Eigen::VectorXd& scales, double factor, double tolerance, bool again,
                               const Poll& poll, AxisWork& work) const {
  pull(scales, factor, work);
  if (!again) {
    work.change.setZero(work.side.size());
    work.first = -1;
  }
  levels_.start(work.levels, !again);
  // What the error's square would be if all vertices were off by rounding.
  const double off = kAxisRounding * factor * grid_.cells[2];
  Approach approach(tolerance, off * off * (matrix_.across.sum() + 2 * matrix_.weights[2].sum()), work.first);
  const double bound = kLeastEdge * std::min(1.0, factor), least = bound - factor;
  BlockPivoting pivoting;
  AxisResult result;
  for (bool changed = true; true;) {
    if (changed) tie(least, work);
    const Correction correction = improve(approach, poll, work);
    result.iterations += correction.iterations;
    result.converged = approach.there(correction);
    measure(least, approach, work);
    changed = pivoting.exchange(work.measure, 1, work.levels.ties.at_bound);
    if (!changed && (result.converged || !correction.gained())) break;
    result.converged = false;
    if (changed && result.rounds++ == kAxisRoundLimit) break;
    if (pivoting.stalled() && approach.tighten()) pivoting = {};  // It may be what solves leave that goes round.
  }
  work.first = approach.first();
  pull_in(least, work);
  result.at_bound = std::count(work.levels.ties.at_bound.begin(), work.levels.ties.at_bound.end(), 1);
  return result;
}

}  // namespace swage
