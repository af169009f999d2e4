#include "intersections.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>

#include "box_tree.h"
#include "crossing.h"
#include "distinct.h"
#include "swage/thrown.h"

namespace swage {
namespace {

using Pairs = std::vector<std::array<int, 2>>;

using Clock = std::chrono::steady_clock;

// Between two questions whether to go on.
constexpr std::chrono::milliseconds kSlice{40};
// Up to as many one thread is done before others are awake.
constexpr int kFewLeaves = 100;

/// In units of a power of two, so that no coordinate is rounded and products neither overflow nor underflow.
Positions in_middle_of_range(const Positions& positions) {
  const double largest = positions.size() == 0 ? 0 : positions.cwiseAbs().maxCoeff();
  if (largest == 0) return positions;
  const int shift = 298 - std::ilogb(largest);
  return positions.unaryExpr([shift](double x) { return std::ldexp(x, shift); });
}

/// Those triangles that span a plane, in a tree.
class BoxedTriangles {
 public:
  BoxedTriangles(const Positions& positions, const Triangles& triangles)
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

/// Searches leaf after leaf, by all threads, in slices of time.
class Search {
 public:
  Search(const BoxedTriangles& surface, std::size_t most)
      : surface_(surface), most_(most), of_leaves_(static_cast<size_t>(surface.leaf_count())) {}

  double part() const { return std::min(1.0, 1.0 * next_ / surface_.leaf_count()); }
  bool has_enough() const { return found_ > most_; }
  bool is_done() const { return next_ >= surface_.leaf_count() || has_enough(); }

  /// A leaf once taken is searched to its end: those searched are always the first ones, whatever the threads do.
  void slice() {
    const auto end = Clock::now() + kSlice;
    Thrown thrown;
#pragma omp parallel if (surface_.leaf_count() > kFewLeaves)
    thrown.keep([&] {
      while (!is_done() && Clock::now() < end) {
        const int leaf = next_++;
        if (leaf >= surface_.leaf_count()) break;
        Pairs& pairs = of_leaves_[static_cast<size_t>(leaf)];
        pairs = surface_.crossings(leaf, most_);
        found_ += pairs.size();
      }
    });
    thrown.rethrow();
  }

  /// The first `most` by leaves, ascending.
  Pairs pairs() const {
    Pairs all;
    for (const Pairs& more : of_leaves_) all.insert(all.end(), more.begin(), more.end());
    all.resize(std::min(all.size(), most_));
    std::sort(all.begin(), all.end());
    return all;
  }

 private:
  const BoxedTriangles& surface_;
  std::size_t most_;
  std::vector<Pairs> of_leaves_;
  std::atomic<int> next_ = 0;
  std::atomic<std::size_t> found_ = 0;
};

}  // namespace

Crossings self_intersections(const Positions& positions, const Triangles& triangles, std::size_t most_pairs,
                             const std::function<bool(double)>& goes_on) {
  const BoxedTriangles surface(positions, triangles);
  Search search(surface, most_pairs);
  bool going = true;
  while (going && !search.is_done()) {
    search.slice();
    going = !goes_on || goes_on(search.part());
  }
  return {search.pairs(), search.is_done() && !search.has_enough()};
}

}  // namespace swage
