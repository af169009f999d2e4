// Least squares of unknowns that have lower bounds: which of them stand at their bounds.
//
// Portugal, Júdice, Vicente: A comparison of block pivoting and interior-point algorithms for linear least squares
// problems with nonnegative variables. Mathematics of Computation 63, 1994. All entries on the wrong side change sides
// at once while that makes fewer of them; where it does not for some rounds, only the last one does, which never
// cycles.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <vector>

namespace swage {

/// Of each entry whether it stands at its bound. Bytes, not bits: threads write them.
using AtBound = std::vector<char>;

class BlockPivoting {
 public:
  /// Changes sides where `measure` is below -negligible: of an entry at its bound its multiplier, of another the
  /// distance from its bound. False where none does.
  bool exchange(const Eigen::ArrayXd& measure, double negligible, AtBound& at_bound) {
    Eigen::Index wrong = 0, last = 0;
    for (Eigen::Index e = 0; e < measure.size(); ++e) {
      if (measure[e] >= -negligible) continue;
      ++wrong;
      last = e;
    }
    if (wrong == 0) return false;
    const bool all = wrong < fewest_ || tries_ > 0;
    stalled_ = !all;
    tries_ = wrong < fewest_ ? kTries : tries_ - 1;
    fewest_ = std::min(fewest_, wrong);
    for (Eigen::Index e = all ? 0 : last; e <= last; ++e) {
      if (measure[e] < -negligible) at_bound[static_cast<size_t>(e)] ^= 1;
    }
    return true;
  }

  /// Whether only the last one changed sides, as more would not make them fewer.
  bool stalled() const { return stalled_; }

 private:
  static constexpr int kTries = 10;
  Eigen::Index fewest_ = std::numeric_limits<Eigen::Index>::max();
  int tries_ = 0;
  bool stalled_ = false;
};

}  // namespace swage
