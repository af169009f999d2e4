#include "curve_sides.h"

#include <algorithm>
#include <numbers>
#include <tuple>
#include <utility>

#include "adjacency.h"
#include "measures.h"

namespace swage {
namespace {

// A regular polygon of 11 sides turns less: a circle. One of 10 has corners.
constexpr double kCorner = std::numbers::pi * 35 / 180;
constexpr double kAlike = 2;
// Where more runs than this meet is a hub, where no curve goes on.
constexpr int kMostAtVertex = 100;

/// Ends of runs: 2 r where run r begins, 2 r + 1 where it ends.
class RunEnds {
 public:
  RunEnds(const PositionsRef& positions, const std::vector<std::vector<int>>& runs)
      : positions_(positions), runs_(runs) {
    const int count = 2 * static_cast<int>(runs.size());
    std::vector<std::pair<int, int>> pairs;
    pairs.reserve(2 * runs.size());
    for (int end = 0; end < count; ++end) pairs.emplace_back(vertex(end), end);
    at_ = lists_from(static_cast<int>(positions.rows()), pairs);
    for (int end = 0; end < count; ++end) next_.push_back(straightest_alike(end));
  }

  bool is_side_of_curve(int run) const {
    const int after_first = next(2 * run), after_last = next(2 * run + 1);
    if (after_first >= 0 && after_last >= 0) return true;
    const int after = std::max(after_first, after_last);
    return after >= 0 && next(after ^ 1) >= 0;
  }

 private:
  const std::vector<int>& run(int end) const { return runs_[static_cast<size_t>(end / 2)]; }
  int next(int end) const { return next_[static_cast<size_t>(end)]; }
  int vertex(int end) const { return end % 2 == 0 ? run(end).front() : run(end).back(); }
  int before(int end) const { return end % 2 == 0 ? run(end)[1] : run(end)[run(end).size() - 2]; }
  double length(int end) const { return (positions_.row(run(end).back()) - positions_.row(run(end).front())).norm(); }

  /// The end of another run by which the curve goes on; -1 where there is none.
  int straightest_alike(int end) const {
    const Lists::Range others = at_[vertex(end)];
    int found = -1;
    double least = kCorner;
    if (others.size() > kMostAtVertex) return found;
    for (const int other : others) {
      const bool alike = length(other) <= kAlike * length(end) && length(end) <= kAlike * length(other);
      if (other / 2 == end / 2 || !alike) continue;
      const double turn = turn_at(positions_, before(end), vertex(end), before(other));
      if (turn < least) std::tie(found, least) = std::pair(other, turn);
    }
    return found;
  }

  const PositionsRef& positions_;
  const std::vector<std::vector<int>>& runs_;
  Lists at_;
  std::vector<int> next_;
};

}  // namespace

std::vector<bool> are_sides_of_curves(const PositionsRef& positions, const std::vector<std::vector<int>>& runs) {
  const RunEnds ends(positions, runs);
  std::vector<bool> are(runs.size());
  for (size_t r = 0; r < runs.size(); ++r) are[r] = ends.is_side_of_curve(static_cast<int>(r));
  return are;
}

}  // namespace swage
