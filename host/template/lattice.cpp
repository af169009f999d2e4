#include "lattice.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace swage {
namespace {

using Eigen::Index;
using Eigen::RowVector3d;

constexpr double kWorld = 128;  // Wide.
constexpr int kFirst = 8;       // Cells along it.
constexpr int kLast = 1 << 18;
constexpr size_t kManyCells = 300'000;
// A cell has no surface where its middle's value is beyond so many times the way to a corner: fields may grow faster
// than distances. It seems to have some where that value is reached on this way at the slope there, since some grow
// slower.
constexpr double kSteepest = 2;

/// Of the cells those that stay.
void keep_passed(const FieldAt& field, NearCells& near) {
  const Lattice& lattice = near.lattice;
  Positions middles(static_cast<Index>(near.cells.size()), 3);
  for (size_t c = 0; c < near.cells.size(); ++c) {
    middles.row(static_cast<Index>(c)) = lattice.at(near.cells[c]) + RowVector3d::Constant(lattice.width / 2);
  }
  FieldValues found;
  field.evaluate(middles, FieldDerivatives::in_space, found);
  const double way = lattice.width * std::sqrt(3) / 2;
  std::vector<Place> kept;
  near.low.fill(lattice.count);
  near.high.fill(-1);
  for (size_t c = 0; c < near.cells.size(); ++c) {
    const auto at = static_cast<Index>(c);
    const double value = std::abs(found.values[at]);
    if (!(value <= kSteepest * way)) continue;
    kept.push_back(near.cells[c]);
    if (value > way * found.gradients.row(at).norm()) continue;
    for (size_t u = 0; u < 3; ++u) {
      near.low[u] = std::min(near.low[u], near.cells[c][u]);
      near.high[u] = std::max(near.high[u], near.cells[c][u]);
    }
  }
  near.cells = std::move(kept);
}

std::vector<Place> halved(const std::vector<Place>& cells) {
  std::vector<Place> halves;
  halves.reserve(8 * cells.size());
  for (const Place& cell : cells) {
    for (int corner = 0; corner < 8; ++corner) {
      halves.push_back({2 * cell[0] + (corner & 1), 2 * cell[1] + (corner >> 1 & 1), 2 * cell[2] + (corner >> 2)});
    }
  }
  return halves;
}

}  // namespace

int NearCells::extent() const {
  int longest = 0;
  for (size_t u = 0; u < 3; ++u) longest = std::max(longest, high[u] - low[u] + 1);
  return longest;
}

bool NearCells::touch_border() const {
  return std::any_of(low.begin(), low.end(), [](int at) { return at == 0; }) ||
         std::any_of(high.begin(), high.end(), [&](int at) { return at == lattice.count - 1; });
}

NearCells cells_near(const FieldAt& field, int resolution, const Poll& poll) {
  NearCells near{{RowVector3d::Constant(-kWorld / 2), kWorld / kFirst, kFirst}, {}};
  for (int i = 0; i < kFirst * kFirst * kFirst; ++i) {
    near.cells.push_back({i % kFirst, i / kFirst % kFirst, i / (kFirst * kFirst)});
  }
  keep_passed(field, near);
  while (!near.cells.empty() && near.lattice.count < kLast) {
    // Fields that hardly change far away seem to vanish there until cells are small.
    const bool is_sure = !near.touch_border() || near.cells.size() > kManyCells;
    if (near.extent() >= resolution && near.lattice.count > kFirst && is_sure) break;
    ask(poll);
    near.lattice = {near.lattice.corner, near.lattice.width / 2, 2 * near.lattice.count};
    near.cells = halved(near.cells);
    keep_passed(field, near);
  }
  return near;
}

}  // namespace swage
