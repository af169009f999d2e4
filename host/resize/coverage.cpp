#include "coverage.h"

#include <algorithm>

namespace swage {
namespace {

using Eigen::Index;

constexpr Index kCoverTriangles = 1 << 19;  // Asked for at once.
constexpr Index kCells = 1 << 21;           // The same, but for a triangle alone.

/// As many of the first counts as list no more cells than are asked for at once.
Index few_enough(const Eigen::Ref<const Eigen::VectorXi>& counts) {
  Index number = 0;
  for (Index cells = 0; number < counts.size(); ++number) {
    cells += counts[number];
    if (cells > kCells && number > 0) break;
  }
  return number;
}

}  // namespace

void each_coverage(const GridShape& shape, const std::shared_ptr<const Mesh>& mesh, const Backend& backend,
                   const Poll& poll, const UseCells& use) {
  const auto step = backend.carry({mesh, {}});
  const Index count = mesh->triangles.rows();
  Eigen::VectorXi counts, cells;
  for (Index first = 0; first < count; first += kCoverTriangles) {
    ask(poll);
    step->count_cells(shape, {first, std::min(first + kCoverTriangles, count)}, counts);
    for (Index begin = 0; begin < counts.size();) {
      ask(poll);
      const Eigen::VectorXi some = counts.segment(begin, few_enough(counts.tail(counts.size() - begin)));
      step->list_cells(shape, {first + begin, first + begin + some.size()}, some, cells);
      const int* of_triangle = cells.data();
      for (Index i = 0; i < some.size(); of_triangle += some[i++]) {
        use(first + begin + i, {of_triangle, static_cast<size_t>(some[i])});
      }
      begin += some.size();
    }
  }
}

}  // namespace swage
