// Stylizes a shape: it keeps its details while its normals turn to where those of a style point.
//
// Liu, Jacobson: Normal-Driven Spherical Shape Analogies. Computer Graphics Forum 40(5), 2021.
#pragma once

#include <memory>
#include <vector>

#include "swage/backend.h"
#include "swage/handles.h"
#include "swage/mesh.h"
#include "swage/report.h"
#include "swage/style.h"

#pragma GCC visibility push(default)
namespace swage {

/// What a shape resists with (paper section 4.1).
enum class StylizeEnergy {
  arap,   ///< Each vertex's triangles keep their shape up to a rotation: smooth, details kept (eq. 3).
  farap,  ///< Each triangle does, and bends freely against the next: sharp creases (eq. 4).
  acap,   ///< As arap, up to a rotation and a scale: details may grow and shrink (eq. 5), but not all together.
};

/// "arap", "farap", "acap".
const char* to_string(StylizeEnergy energy);

/// How acap finds a neighbourhood's scale s.
enum class AcapScale {
  exact,  ///< The one of least energy, with a mean square over each component of 1, or where handles at several places
          ///< give the size, of what they draw together to at least: all would shrink to a point else.
  paper,  ///< By the formula of appendix C, which counts the normals' term. The energy may rise.
};

/// What edges count.
enum class StylizeWeights {
  cotangent,           ///< Cotangents of the angles opposite, as the paper: less than nothing where these sum to more
                       ///< than pi, and there triangles turn over more easily.
  clamped,             ///< The same, but obtuse angles count as right ones.
  intrinsic_delaunay,  ///< Cotangents of the surface's intrinsic Delaunay triangulation, where no two angles opposite
                       ///< an edge sum to more than pi. Its edges stand for the straight lines between their ends. Not
                       ///< for farap, whose triangles are the mesh's own.
};

/// "cotangent", "clamped", "intrinsic delaunay".
const char* to_string(StylizeWeights weights);

struct StylizeOptions {
  StylizeEnergy energy = StylizeEnergy::arap;
  StylizeWeights weights = StylizeWeights::cotangent;
  AcapScale scale = AcapScale::exact;  ///< Of acap.
  int pass_limit = 350;                ///< At least 1.
  double movement = 2e-4;              ///< max|U - U_prev| / max|U - V|, at least 0, over all coordinates: passes end
                                       ///< that move less.
  int acceleration_window = 0;         ///< Passes that the next start is made of, [0, 50]; 0 for plain ones, as the
                                       ///< paper. Such a start counts where the energy there, of the targets that it
                                       ///< has, is not above the last pass's. The fixed point is the same.
  std::shared_ptr<Backend> backend;    ///< Does the local steps; cpu_backend() where none is given.
};

/// The objective after a pass (eq. 3), mesh units squared, for the targets that the pass had.
struct StylizeTerms {
  double shape = 0;    ///< sum w |R e - e'|²
  double normals = 0;  ///< sum a |R n - t|², without lambda.
};

struct StylizeResult {
  Positions positions;               ///< #V × 3, mesh units, the input's order.
  std::vector<StylizeTerms> passes;  ///< After each.
  Report report;                     ///< Its energies are shape + lambda normals.
  /// Where normals were to point at first, and in the last pass: those of triangles by farap, else of vertices, of the
  /// input, whose triangles' winding they follow. Unit; zero where any direction does, and of what is not solved:
  /// triangles that are there twice or have no area, vertices of none. Empty where no pass was made.
  GivenNormals first_targets, last_targets;
};

struct StylizePlan;  ///< What is kept of a mesh between solves.

/// Stylizes one mesh, any number of times. prepare() and solve() may be called from several threads at once. Solves
/// share all but the style; those with the same handles, wherever they go, share one factorisation.
class Stylize {
 public:
  /// Takes any list of triangles, as Reshape does; it need not be closed. Throws InvalidInput where check(positions,
  /// triangles) does, no triangle has an area, or an option is out of its range.
  Stylize(const PositionsRef& positions, const TrianglesRef& triangles, const StylizeOptions& options = {});
  ~Stylize();
  Stylize(Stylize&&) noexcept;
  Stylize& operator=(Stylize&&) noexcept;

  /// Prepares all that depends on the rest shape alone; the first solve does so where it was not done before. Returns
  /// false where `progress` cancelled.
  bool prepare(const ProgressFn& progress = {});

  /// `lambda`, at least 0: how much the style counts against the shape. Handles are met exactly; of components without
  /// any, a vertex of the first triangle stays in its place.
  /// Throws InvalidInput where lambda is out of its range, the style does not fit or is not finite, or check(gesture,
  /// positions, triangles) throws for handles that are not empty; and Unsolvable where the system is singular.
  StylizeResult solve(const Style& style, double lambda = 1, const Gesture& handles = {},
                      const ProgressFn& progress = {});

 private:
  std::unique_ptr<StylizePlan> plan_;
};

/// One style on one mesh.
StylizeResult stylize(const PositionsRef& positions, const TrianglesRef& triangles, const Style& style,
                      double lambda = 1, const StylizeOptions& options = {}, const Gesture& handles = {},
                      const ProgressFn& progress = {});

}  // namespace swage
#pragma GCC visibility pop
