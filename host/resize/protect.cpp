// The user's say, laid over the map.
#include <algorithm>
#include <cmath>
#include <string>

#include "coverage.h"
#include "messages.h"
#include "plan.h"
#include "swage/error.h"

namespace swage {
namespace {

using Eigen::Index;

constexpr double kGrazing = 1e-9;  // Cells: a box that ends where a cell begins does not touch it.

[[noreturn]] void refuse_protection(const std::string& what) { throw InvalidInput("Resize: protection." + what); }

void check_protection(const ResizePlan& plan, const Protection& protection) {
  if (!(protection.value >= 0 && protection.value <= 1))
    refuse_protection("value: " + digits(protection.value) + " is not in [0, 1]");
  for (const int t : protection.triangles) {
    if (t < 0 || t >= plan.mesh->triangles.rows()) {
      refuse_protection("triangles: " + std::to_string(t) + " is none of the " +
                        std::to_string(plan.mesh->triangles.rows()) + " triangles");
    }
  }
  if (protection.box && !(protection.box->min().array() <= protection.box->max().array()).all()) {
    refuse_protection("box: a corner is not a number, or the lower is above the upper along an axis; mend them");
  }
}

/// From the first to the last along an axis.
struct Span {
  int first, last;
};

Span span_of(const GridShape& shape, const Eigen::AlignedBox3d& box, int u) {
  if (!shape.extends(u))
    return box.min()[u] <= shape.corner[u] && box.max()[u] >= shape.corner[u] ? Span{0, 0} : Span{0, -1};
  const double count = shape.cells[u];
  const auto cells = [&](double at) {
    return std::clamp((at - shape.corner[u]) / shape.size[u] * count, -1.0, count + 1);
  };
  double low = std::floor(cells(box.min()[u]) + kGrazing);
  const double end = cells(box.max()[u]), high = std::ceil(end - kGrazing) - 1;
  if (end <= count) low = std::min(low, count - 1);  // Of a box without thickness on the grid's upper face.
  return {static_cast<int>(std::max(low, 0.0)), static_cast<int>(std::min(std::max(high, low), count - 1))};
}

std::vector<Index> cells_in(const GridShape& shape, const Eigen::AlignedBox3d& box) {
  const Span x = span_of(shape, box, 0), y = span_of(shape, box, 1), z = span_of(shape, box, 2);
  std::vector<Index> cells;
  for (int k = z.first; k <= z.last; ++k) {
    for (int j = y.first; j <= y.last; ++j) {
      for (int i = x.first; i <= x.last; ++i) cells.push_back(shape.cells.at(i, j, k));
    }
  }
  return cells;
}

/// Some triangles, each with vertices of its own.
Mesh alone(const Mesh& mesh, const std::vector<int>& triangles) {
  Mesh some{Positions(3 * triangles.size(), 3), Triangles(triangles.size(), 3)};
  for (Index corner = 0; corner < some.triangles.size(); ++corner) {
    const int t = triangles[static_cast<size_t>(corner / 3)];
    some.positions.row(corner) = mesh.positions.row(mesh.triangles(t, corner % 3));
    some.triangles.data()[corner] = static_cast<int>(corner);
  }
  return some;
}

}  // namespace

void protect(ResizePlan& plan, const Protection& protection) {
  check_protection(plan, protection);
  std::vector<Index> cells;
  if (protection.box) cells = cells_in(plan.shape, *protection.box);
  const auto chosen = std::make_shared<Mesh>(alone(*plan.mesh, protection.triangles));
  each_coverage(plan.shape, chosen, *plan.options.backend, {}, [&](Index, std::span<const int> touched) {
    cells.insert(cells.end(), touched.begin(), touched.end());
  });
  if (cells.empty()) refuse_protection("triangles, box: they touch no cell of the grid; select others");
  for (int u = 0; u < 3; ++u) {
    if (!protection.axes[static_cast<size_t>(u)]) continue;
    for (const Index c : cells) plan.said(c, u) = protection.value;
  }
  count_map(plan);
}

}  // namespace swage
