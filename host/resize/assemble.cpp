#include "assemble.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "axis_assembly.h"
#include "folds.h"
#include "messages.h"
#include "pool.h"
#include "swage/error.h"

namespace swage {

using Eigen::Index;

using Axes = std::array<std::optional<AxisAssembly>, 3>;  // None where the box has no extent.

namespace {

constexpr const char* kCaller = "Assembly";
constexpr double kStiffening = 10;
constexpr int kStiffeningLimit = 8;
constexpr int kHalvings = 8;  // Of what is not known of the way to plain scaling.

/// What one thread at a time works with.
struct AssemblyWork {
  std::array<std::optional<AxisWork>, 3> axes;
};

struct Asked {
  const AxisValues& scales;
  const Eigen::RowVector3d& factors;
  const AssemblyOptions& options;
  const Poll& poll;
};

Axes axes_of(const GridShape& shape, const CellMap& map) {
  Axes axes;
  for (int u = 0; u < 3; ++u) {
    if (shape.extends(u)) axes[static_cast<size_t>(u)].emplace(shape.cells, map, u);
  }
  return axes;
}

void put(const GridShape& shape, const TurnedGrid& grid, double factor, const Values<double>& change,
         AxisValues& positions) {
  const Extents vertices = shape.vertices();
  const int u = grid.axis;
  const double length = shape.size[u] / shape.cells[u];
#pragma omp parallel for schedule(static) if (shape.cells.count() > kManyEntries)
  for (int k = 0; k < vertices[2]; ++k) {
    for (int j = 0; j < vertices[1]; ++j) {
      for (int i = 0; i < vertices[0]; ++i) {
        const std::array<int, 3> at = {i, j, k};
        const double part = static_cast<double>(at[static_cast<size_t>(u)]) / shape.cells[u];
        positions(vertices.at(i, j, k), u) =
            shape.corner[u] + part * (shape.size[u] * factor) + length * change[grid.vertex(i, j, k)];
      }
    }
  }
}

void place_axes(const GridShape& shape, const Axes& axes, const Asked& asked, bool again, AssemblyWork& work,
                GridVertices& result) {
  result.at_bound = 0;
  for (int u = 0; u < 3; ++u) {
    if (!shape.extends(u)) continue;
    const AxisAssembly& axis = *axes[static_cast<size_t>(u)];
    AxisWork& own = *work.axes[static_cast<size_t>(u)];
    const double factor = asked.factors[u];
    const AxisResult found = axis.solve(asked.scales.col(u), factor, asked.options.tolerance, again, asked.poll, own);
    result.iterations += found.iterations;
    result.rounds += found.rounds;
    result.at_bound += found.at_bound;
    result.converged = result.converged && found.converged;
    put(shape, axis.grid(), factor, own.change, result.positions);
  }
}

/// A tenth of the smallest box that the bounds allow.
double least_volume(const GridShape& shape, const Eigen::RowVector3d& factors) {
  double least = 0.1;
  for (int u = 0; u < 3; ++u) least *= shape.extends(u) ? kLeastEdge * std::min(1.0, factors[u]) : 1;
  return least;
}

/// Goes towards plain scaling, which folds nothing, as little as it takes until no cell is folded.
void unfold(const GridShape& shape, const Eigen::RowVector3d& factors, double least, AxisValues& positions) {
  AxisValues plain = rest_vertices(shape);
  for (int u = 0; u < 3; ++u) {
    const double factor = shape.extends(u) ? factors[u] : 1;
    plain.col(u) = shape.corner[u] + factor * (plain.col(u).array() - shape.corner[u]);
  }
  const AxisValues folded = positions;
  double low = 0, high = 1;  // Parts of the way: folded, and not.
  for (int half = 0; half < kHalvings; ++half) {
    const double part = 0.5 * (low + high);
    positions = (1 - part) * folded + part * plain;
    (folded_cells(shape, positions, least).empty() ? high : low) = part;
  }
  positions = (1 - high) * folded + high * plain;
}

}  // namespace

struct Assembly::Plan {
  GridShape shape;
  CellMap map;
  Axes axes;
  Pool<AssemblyWork> works = {};

  std::unique_ptr<AssemblyWork> new_work() const;
};

std::unique_ptr<AssemblyWork> Assembly::Plan::new_work() const {
  auto work = std::make_unique<AssemblyWork>();
  for (size_t u = 0; u < 3; ++u) {
    if (axes[u]) work->axes[u].emplace(*axes[u]);
  }
  return work;
}

Assembly::Assembly(const GridShape& shape, const CellMap& map) {
  check(kCaller, shape, map);
  plan_.reset(new Plan{shape, map, axes_of(shape, map)});
  plan_->works.lend([&] { return plan_->new_work(); });
}
Assembly::~Assembly() = default;
Assembly::Assembly(Assembly&&) noexcept = default;
Assembly& Assembly::operator=(Assembly&&) noexcept = default;

GridVertices Assembly::place(const AxisValues& scales, const Eigen::RowVector3d& factors,
                             const AssemblyOptions& options, const Poll& poll) const {
  const GridShape& shape = plan_->shape;
  check_factors(kCaller, shape, factors);
  if (scales.rows() != shape.cells.count()) {
    throw InvalidInput("Assembly: scales: " + std::to_string(scales.rows()) + " rows, but there are " +
                       std::to_string(shape.cells.count()) + " cells; give one for each");
  }
  if (const Index row = first_not_finite(scales); row >= 0) {
    throw InvalidInput("Assembly: scales: row " + std::to_string(row) + " is not finite; mend it");
  }
  if (!(options.tolerance > 0 && options.tolerance < 1)) {
    throw InvalidInput("Assembly: options.tolerance: " + digits(options.tolerance) + " is not in (0, 1)");
  }
  const auto work = plan_->works.lend([&] { return plan_->new_work(); });
  const Asked asked = {scales, factors, options, poll};
  GridVertices result;
  result.positions = rest_vertices(shape);
  place_axes(shape, plan_->axes, asked, false, *work, result);

  const double least = least_volume(shape, factors);
  CellMap stiff;
  for (std::vector<Index> folded = folded_cells(shape, result.positions, least); !folded.empty();
       folded = folded_cells(shape, result.positions, least)) {
    if (result.stiffened == kStiffeningLimit) {
      unfold(shape, factors, least, result.positions);
      result.converged = false;
      break;
    }
    if (result.stiffened++ == 0) stiff = plan_->map;
    for (const Index c : folded) stiff.phi[c] *= kStiffening;
    place_axes(shape, axes_of(shape, stiff), asked, true, *work, result);
  }
  return result;
}

}  // namespace swage
