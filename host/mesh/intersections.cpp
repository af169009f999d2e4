#include "intersections.h"

#include <algorithm>
#include <cmath>

#include "box_tree.h"
#include "crossing.h"
#include "weld.h"

namespace swage {
namespace {

using Pairs = std::vector<std::array<int, 2>>;

// Leaves between two questions whether to go on. The same for any number of threads.
constexpr int kBatch = 128;

/// In units of a power of two, so that no coordinate is rounded and products neither overflow nor underflow.
Positions in_middle_of_range(const Positions& positions) {
  const double largest = positions.size() == 0 ? 0 : positions.cwiseAbs().maxCoeff();
  if (largest == 0) return positions;
  const int shift = 298 - std::ilogb(largest);
  return positions.unaryExpr([shift](double x) { return std::ldexp(x, shift); });
}

/// Those triangles that span a plane, in a tree.
class Surface {
 public:
  Surface(const Positions& positions, const Triangles& triangles)
      : positions_(in_middle_of_range(positions)),
        triangles_(welded(triangles, first_at_place(positions))),
        boxes_(keep_and_bound()),
        tree_(boxes_) {}

  int leaf_count() const { return tree_.leaf_count(); }

  /// Crossings that the leaf is to tell of; ends at the first beyond `most`.
  Pairs crossings(int leaf, std::size_t most) const {
    Pairs pairs;
    tree_.overlaps(leaf, [&](int i, int j) {
      const int a = kept_[static_cast<size_t>(i)], b = kept_[static_cast<size_t>(j)];
      if (cross(corners(a), corners(b))) pairs.push_back({a, b});
      return pairs.size() <= most;
    });
    return pairs;
  }

 private:
  Corners corners(int triangle) const {
    Corners result;
    for (int k = 0; k < 3; ++k) {
      const auto at = static_cast<size_t>(k);
      result.vertices[at] = triangles_(triangle, k);
      result.points[at] = positions_.row(triangles_(triangle, k));
    }
    return result;
  }

  std::vector<Eigen::AlignedBox3d> keep_and_bound() {
    std::vector<Eigen::AlignedBox3d> boxes;
    for (int t = 0; t < triangles_.rows(); ++t) {
      const Corners triangle = corners(t);
      if (!spans_a_plane(triangle)) continue;
      kept_.push_back(t);
      boxes.emplace_back(triangle.points[0]).extend(triangle.points[1]).extend(triangle.points[2]);
    }
    return boxes;
  }

  Positions positions_;
  Triangles triangles_;    ///< Vertices at one place have one name.
  std::vector<int> kept_;  ///< Triangle of each box.
  std::vector<Eigen::AlignedBox3d> boxes_;
  BoxTree tree_;
};

Pairs crossings_of_batch(const Surface& surface, int first, int last, std::size_t most) {
  std::vector<Pairs> of_leaves(static_cast<size_t>(last - first));
#pragma omp parallel for schedule(dynamic, 4)
  for (int leaf = first; leaf < last; ++leaf) {
    of_leaves[static_cast<size_t>(leaf - first)] = surface.crossings(leaf, most);
  }
  Pairs pairs;
  for (const Pairs& more : of_leaves) pairs.insert(pairs.end(), more.begin(), more.end());
  return pairs;
}

}  // namespace

Crossings self_intersections(const Positions& positions, const Triangles& triangles, std::size_t most_pairs,
                             const std::function<bool(double)>& goes_on) {
  Crossings crossings;
  Pairs& pairs = crossings.pairs;
  const Surface surface(positions, triangles);
  for (int leaf = 0; leaf < surface.leaf_count() && crossings.complete; leaf += kBatch) {
    const int end = std::min(leaf + kBatch, surface.leaf_count());
    const Pairs more = crossings_of_batch(surface, leaf, end, most_pairs - pairs.size());
    pairs.insert(pairs.end(), more.begin(), more.end());
    crossings.complete = pairs.size() <= most_pairs && (!goes_on || goes_on(1.0 * end / surface.leaf_count()));
  }
  pairs.resize(std::min(pairs.size(), most_pairs));
  std::sort(pairs.begin(), pairs.end());
  return crossings;
}

}  // namespace swage
