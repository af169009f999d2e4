#include "lattice.h"

#include <algorithm>

namespace swage {
namespace {

using Eigen::Index;
using Eigen::RowVector3d;

constexpr double kWorld = 128;  // Wide.
constexpr int kFirst = 8;       // Cells along it.
constexpr int kLast = 1 << 18;
// A cell has no surface where its middle's value is beyond so many times what a distance would be. Fields may grow
// faster than distances.
constexpr double kSteepest = 2;

std::vector<Place> passed(const FieldAt& field, const Lattice& lattice, const std::vector<Place>& cells) {
  Positions middles(static_cast<Index>(cells.size()), 3);
  for (size_t c = 0; c < cells.size(); ++c) {
    middles.row(static_cast<Index>(c)) = lattice.at(cells[c]) + RowVector3d::Constant(lattice.width / 2);
  }
  FieldValues found;
  field.evaluate(middles, FieldDerivatives::none, found);
  const double farthest = kSteepest * lattice.width * std::sqrt(3) / 2;
  std::vector<Place> kept;
  for (size_t c = 0; c < cells.size(); ++c) {
    if (std::abs(found.values[static_cast<Index>(c)]) <= farthest) kept.push_back(cells[c]);
  }
  return kept;
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
  for (size_t u = 0; u < 3; ++u) {
    const auto [low, high] =
        std::minmax_element(cells.begin(), cells.end(), [&](const Place& a, const Place& b) { return a[u] < b[u]; });
    if (low != cells.end()) longest = std::max(longest, (*high)[u] - (*low)[u] + 1);
  }
  return longest;
}

bool NearCells::touch_border() const {
  return std::any_of(cells.begin(), cells.end(), [&](const Place& cell) {
    return std::any_of(cell.begin(), cell.end(), [&](int at) { return at == 0 || at == lattice.count - 1; });
  });
}

NearCells cells_near(const FieldAt& field, int resolution, const Poll& poll) {
  NearCells near{{RowVector3d::Constant(-kWorld / 2), kWorld / kFirst, kFirst}, {}};
  for (int i = 0; i < kFirst * kFirst * kFirst; ++i) {
    near.cells.push_back({i % kFirst, i / kFirst % kFirst, i / (kFirst * kFirst)});
  }
  near.cells = passed(field, near.lattice, near.cells);
  while (!near.cells.empty() && near.lattice.count < kLast) {
    // Where cells are large, those that may have surface go far beyond it.
    const bool is_told = near.extent() >= resolution && near.lattice.count > kFirst;
    if (is_told) break;
    ask(poll);
    near.lattice = {near.lattice.corner, near.lattice.width / 2, 2 * near.lattice.count};
    near.cells = passed(field, near.lattice, halved(near.cells));
  }
  return near;
}

}  // namespace swage
