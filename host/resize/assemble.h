// The grid's vertices from its cells' scales: Kraevoy, Sheffer, Shamir, Cohen-Or: Non-Homogeneous Resizing of Complex
// Models, 2008, section 5.2, with lower bounds.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "cancel.h"
#include "grid.h"

namespace swage {

constexpr double kLeastVulnerability = 1e-3;
/// What shear counts beside scales. The paper's 1 leaves wheels, dials and hatches twice to four times as far from
/// round.
constexpr double kOrthogonality = 0.05;

struct AssemblyOptions {
  double tolerance = 1e-6;  ///< Part of the error that may be left, in (0, 1).
};

struct GridVertices {
  AxisValues positions;       ///< #(nx+1)(ny+1)(nz+1) × 3, in mesh units, x fastest. The lowest corner stays.
  int iterations = 0;         ///< Of conjugate gradients, over all axes and rounds.
  int rounds = 0;             ///< How often edges were held at the bound, or let go.
  Eigen::Index at_bound = 0;  ///< Edges that stand at the lower bound.
  int stiffened = 0;          ///< How often cells that folded were made stiffer.
  bool converged = true;
};

/// Minimises, for each axis u by itself, over all cells c
///   max(theta_u, 1e-3) (x_2 - x_1 - s_u h_u)² on the cell's four edges along u, h_u their length at rest
///   + 0.05 phi (x_2 - x_1)² on its eight others,
/// where the outer faces across u are the asked size apart and no edge along u is shorter than
/// kLeastEdge min(1, S_u) h_u. Edges of that length do not keep a sheared cell from folding: phi of cells that do is
/// raised tenfold, and all is solved again, until none does. Where that does not help, the grid goes as far towards
/// plain scaling as it takes, and has not converged. Deterministic: the same bytes from any number of threads.
class Assembly {
 public:
  /// All that does not depend on the scales. Throws InvalidInput.
  Assembly(const GridShape& shape, const CellMap& map);
  ~Assembly();
  Assembly(Assembly&&) noexcept;
  Assembly& operator=(Assembly&&) noexcept;

  /// `scales`: #C × 3. `factors`: S, the asked size is S times the box's. May be called from several threads. Throws
  /// InvalidInput, and Cancelled from `poll`.
  GridVertices place(const AxisValues& scales, const Eigen::RowVector3d& factors, const AssemblyOptions& options = {},
                     const Poll& poll = {}) const;

 private:
  struct Plan;
  std::unique_ptr<Plan> plan_;
};

}  // namespace swage
