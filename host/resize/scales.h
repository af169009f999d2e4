// The scale of each cell along each axis: Kraevoy, Sheffer, Shamir, Cohen-Or: Non-Homogeneous Resizing of Complex
// Models, 2008, section 5.1, with lower bounds.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "cancel.h"
#include "grid.h"

namespace swage {

constexpr double kCompatibility = 4.0 / 3;
constexpr double kLeastModulation = 1e-4;

/// g: 1 where it is between the factors, else the factor nearest to it.
double unit_scale(const GridShape& shape, const Eigen::RowVector3d& factors);

struct ScaleOptions {
  /// What a vulnerable cell pays for changing its size, theta (s - 1)² times this. 0: vulnerable cells keep their shape
  /// and may grow or shrink.
  double size_weight = 0;
  double tolerance = 1e-6;  ///< Part of the error that may be left, in (0, 1).
};

struct Scales {
  AxisValues values;          ///< #C × 3: each row of cells along an axis has the axis's factor as its mean.
  int iterations = 0;         ///< Of conjugate gradients, over all rounds.
  int rounds = 0;             ///< How often cells were held at the bound, or let go.
  Eigen::Index at_bound = 0;  ///< Scales that stand at the lower bound.
  bool converged = true;
};

/// Minimises, over all cells c, modulation and compatibility
///   sum over pairs of axes u, v of max(min(theta_u, theta_v), 1e-4) (s_u / a_u - s_v / a_v)²
///   + sum over cells d next to c along w of 4/3 phi_c phi_d sum over u other than w of (s_c^u - s_d^u)²,
/// a_u = theta_u g + (1 - theta_u) S_u, where the means of rows are S_u and no scale is below kLeastScale min(1, S_u).
/// g is 1 as in the paper while 1 is between the factors, else the factor nearest to 1: so that where all factors are
/// one, so are all scales. Along an axis in which the box has no extent scales are 1 and left out.
/// Deterministic: the same bytes from any number of threads.
class ScaleSolve {
 public:
  /// All that does not depend on the factors. Throws InvalidInput.
  ScaleSolve(const GridShape& shape, const CellMap& map);
  ~ScaleSolve();
  ScaleSolve(ScaleSolve&&) noexcept;
  ScaleSolve& operator=(ScaleSolve&&) noexcept;

  /// `factors`: S, in [1e-6, 1e6]. May be called from several threads. Throws InvalidInput, and Cancelled from `poll`.
  Scales solve(const Eigen::RowVector3d& factors, const ScaleOptions& options = {}, const Poll& poll = {}) const;

 private:
  struct Plan;
  std::unique_ptr<Plan> plan_;
};

}  // namespace swage
