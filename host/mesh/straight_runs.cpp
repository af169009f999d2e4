#include "straight_runs.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include <Eigen/Geometry>

namespace swage {
namespace {

using Run = std::pair<int, int>;

class Polyline {
 public:
  Polyline(const Positions& points, double deviation, double shortest)
      : points_(points),
        deviation_(deviation),
        shortest_(shortest),
        along_{0},
        open_{{0, static_cast<int>(points.rows()) - 1}} {
    for (Eigen::Index i = 1; i < points.rows(); ++i) {
      const double step = (points.row(i) - points.row(i - 1)).norm();
      along_.push_back(along_.back() + step);
      shortest_step_ = std::min(shortest_step_, step);
    }
  }

  /// Looks through windows of half the length each time: one lies within a run of at least 2/5 of the run's length.
  std::vector<Run> straight_runs() && {
    const double least = std::max(shortest_ / 4, shortest_step_);
    double window = along_.back();
    while (window > least) {
      for (const Run& part : std::exchange(open_, {})) take_runs(part, window);
      window /= 2;
    }
    for (const auto& [first, last] : open_) {
      for (int i = first; i < last; ++i) take({i, i + 1});
    }
    std::sort(runs_.begin(), runs_.end());
    return std::move(runs_);
  }

 private:
  double at(int point) const { return along_[static_cast<size_t>(point)]; }
  double length(const Run& run) const { return at(run.second) - at(run.first); }

  /// The first point at least so far along.
  int reach(double distance) const {
    return static_cast<int>(std::lower_bound(along_.begin(), along_.end(), distance) - along_.begin());
  }

  bool is_straight(const Run& run) const {
    const Eigen::RowVector3d from = points_.row(run.first), chord = points_.row(run.second) - from;
    const double farthest = deviation_ * length(run) * length(run) / along_.back();
    if (!(chord.norm() > length(run) / 2)) return false;
    const Eigen::RowVector3d direction = chord.normalized();
    for (int i = run.first + 1; i < run.second; ++i) {
      if (!((points_.row(i) - from).cross(direction).norm() <= farthest + kRounding * length(run))) return false;
    }
    return true;
  }

  bool take(const Run& run) {
    if (length(run) < shortest_) return false;
    runs_.push_back(run);
    return true;
  }

  /// Those of three points or more in a part; what is between them stays open.
  void take_runs(Run part, double window) {
    for (int i = part.first; i + 2 <= part.second; i = std::max(i + 1, reach(at(i) + window / 4))) {
      Run run{i, std::max(i + 2, reach(at(i) + window * (1 - kRounding)))};
      if (run.second > part.second) break;
      if (!is_straight(run)) continue;
      run = extended(run, part);
      if (!take(run)) continue;
      open_.emplace_back(part.first, run.first);
      part.first = i = run.second;
    }
    open_.push_back(part);
  }

  Run extended(Run run, const Run& part) const {
    for (int step = static_cast<int>(std::bit_floor(static_cast<unsigned>(part.second - part.first))); step > 0;
         step /= 2) {
      const Run later{run.first, run.second + step};
      if (later.second <= part.second && is_straight(later)) run = later;
      const Run earlier{run.first - step, run.second};
      if (earlier.first >= part.first && is_straight(earlier)) run = earlier;
    }
    return run;
  }

  static constexpr double kRounding = 1e-12;

  const Positions& points_;
  double deviation_, shortest_;
  std::vector<double> along_;  ///< Length up to each point.
  double shortest_step_ = std::numeric_limits<double>::infinity();
  std::vector<Run> open_;  ///< Parts in which more may be found.
  std::vector<Run> runs_;
};

}  // namespace

std::vector<Run> straight_runs(const Positions& points, double deviation, double shortest) {
  return Polyline(points, deviation, shortest).straight_runs();
}

}  // namespace swage
