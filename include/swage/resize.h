// Resizes a model of any parts to a new size: what must not distort keeps its shape, what does not mind takes the
// stretch.
//
// Kraevoy, Sheffer, Shamir, Cohen-Or: Non-Homogeneous Resizing of Complex Models. SIGGRAPH Asia 2008.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include "swage/backend.h"
#include "swage/mesh.h"
#include "swage/protective_grid.h"
#include "swage/report.h"

#pragma GCC visibility push(default)
namespace swage {

struct VulnerabilityOptions {
  double crease_angle = std::numbers::pi * 150 / 180;  ///< Interior dihedral angle, radians, [0, pi]: sharper edges
                                                       ///< are creases, not curvature.
  double slippage_limit = 0.1;       ///< |n · u|, in (0, 1], from which a face counts as wholly vulnerable.
  double curvature_limit = 1.0 / 3;  ///< The same of its normal curvature along u, in 1 / box diagonals, above 0.
  double least_curvature = 1e-4;     ///< epsilon_kappa, [0, 1]: what curvature counts as at least.
};

/// How vulnerable each triangle is to scaling along each axis, #F × 3 each, in [0, 1] (paper section 4).
struct Vulnerability {
  AxisValues slippage;   ///< How far scaling takes the surface off itself; the mean with edge neighbours.
  AxisValues curvature;  ///< How much it curves along the axis.
  AxisValues theta;      ///< slippage (least_curvature + curvature), at most 1.
};

/// Triangles without area have none. Vertices at one place are one, repeated triangles count once.
/// Throws InvalidInput as check() does, and for an option out of its range.
Vulnerability vulnerability(const PositionsRef& positions, const TrianglesRef& triangles,
                            const VulnerabilityOptions& options = {}, const Backend& backend = *cpu_backend());

struct ResizeOptions {
  VulnerabilityOptions vulnerability;
  std::array<int, 3> cells = {0, 0, 0};  ///< Along each axis, [0, 1000], 10 million in all; 0: chosen so that cells are
                                         ///< as close to cubes as may be, `longest` along the longest side.
  int longest = 60;                      ///< [5, 1000]. Axes chosen get 5 at least.
  double tolerance = 1e-6;               ///< Part of the error that solves may leave, (0, 1).
  std::shared_ptr<Backend> backend;      ///< Does the local steps; cpu_backend() where none is given.
};

/// What vulnerable parts keep.
enum class ResizeKeep {
  shape,  ///< As the paper: they may grow and shrink, all axes alike.
  size,   ///< They keep their size as far as there is room: each cell pays theta (s - 1)² for its scale s.
};

/// What stays in its place along an axis.
enum class ResizeAnchor { low, center, high };

struct ResizeTarget {
  Eigen::RowVector3d factors{1, 1, 1};  ///< The new size of the box over the old, each in [1e-6, 1e6]. Along axes in
                                        ///< which the model has no extent they mean nothing.
  ResizeKeep keep = ResizeKeep::shape;
  double size_weight = 10;  ///< Of ResizeKeep::size, above 0: times what each cell pays. More keeps size a little
                            ///< better where there is room, and shape worse where there is little.
  std::array<ResizeAnchor, 3> anchors = {ResizeAnchor::low, ResizeAnchor::low, ResizeAnchor::low};
};

/// What the user knows better. Laid over the map: where several touch a cell, the last counts.
struct Protection {
  std::vector<int> triangles;              ///< Cells that these touch, and
  std::optional<Eigen::AlignedBox3d> box;  ///< those that this box touches, mesh units.
  std::array<bool, 3> axes = {true, true, true};
  double value = 1;  ///< [0, 1]: their vulnerability; 0 releases them.
};

struct ResizeResult {
  Positions positions;         ///< #V × 3, mesh units, the input's order; the rest shape where cancelled.
  Eigen::RowVector3d factors;  ///< The asked ones; 1 along axes in which the model has no extent.
  AxisValues scales;           ///< #C × 3: of each cell.
  AxisValues grid;             ///< Vertices of the grid, #(nx+1)(ny+1)(nz+1) × 3, mesh units. No cell is turned over.
  double least_scale = 1;      ///< Of all cells, along any axis.
  double least_edge = 1;       ///< Of all edges of the grid, new length along their axis over the old.
  Eigen::RowVector3d kept_scale;     ///< Mean scale of cells along each axis, weighted by their vulnerability; 1 where
                                     ///< none is vulnerable.
  Eigen::Index scales_at_bound = 0;  ///< How many stand at their lower bound.
  Eigen::Index edges_at_bound = 0;
  Report report;  ///< Seconds by stage: vulnerability, coverage, grid, scales, assembly, carry, precompute, solve.
};

struct ResizePlan;  ///< What is kept of a model between solves.

/// Resizes one model, any number of times. Several threads may solve at once, but not while the map is changed.
class Resize {
 public:
  /// Takes any list of triangles: soups, non-manifold, of hundreds of components. The box is that of all vertices.
  /// Throws InvalidInput where check(positions, triangles) does, all vertices are at one place, or an option is out of
  /// its range.
  Resize(const PositionsRef& positions, const TrianglesRef& triangles, const ResizeOptions& options = {});
  ~Resize();
  Resize(Resize&&) noexcept;
  Resize& operator=(Resize&&) noexcept;

  /// Finds the vulnerability and the cells that faces touch; whatever first needs them does so where it was not done
  /// before. Returns false where `progress` cancelled.
  bool prepare(const ProgressFn& progress = {});

  const GridShape& shape() const;        ///< Of the protective grid.
  const Vulnerability& vulnerability();  ///< Of the triangles, as found.
  /// As it counts: as found, with what was laid over it and what vulnerable cells then enclose, such as a dial's rim
  /// its middle.
  const CellMap& map();

  /// Throws InvalidInput where a triangle or the box's numbers are none, nothing is touched, or the value is out of its
  /// range.
  void protect(const Protection& protection);
  /// Any other map. Throws InvalidInput, naming the cell, where it does not fit.
  void set_map(const CellMap& map);
  /// As found.
  void reset_map();

  /// Throws InvalidInput where the target is out of its range.
  ResizeResult solve(const ResizeTarget& target, const ProgressFn& progress = {});

 private:
  std::unique_ptr<ResizePlan> plan_;
};

/// One target for one model.
ResizeResult resize(const PositionsRef& positions, const TrianglesRef& triangles, const ResizeTarget& target,
                    const ResizeOptions& options = {}, const ProgressFn& progress = {});

/// The grid as a surface, to be looked at: the faces between cells that `phi` says faces touch and others, each of two
/// triangles. `vertices`: as rest_vertices() or ResizeResult::grid have them; `cells`, where not null: of each triangle
/// the cell that it bounds.
Mesh grid_surface(const GridShape& shape, const CellMap& map, const AxisValues& vertices,
                  std::vector<int>* cells = nullptr);

}  // namespace swage
#pragma GCC visibility pop
