// Finds the parameters with which a template is most like a mesh.
//
// Kusupati, Gaillard, Thiery, Kaiser: Semantic Shape Editing with Parametric Implicit Templates. SIGGRAPH 2024,
// section 4.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "swage/backend.h"
#include "swage/mesh.h"
#include "swage/report.h"
#include "swage/template.h"

#pragma GCC visibility push(default)
namespace swage {

/// Where a mesh lies in the space of its template: x there is scale rotation p + offset.
struct TemplatePose {
  double scale = 1;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::RowVector3d offset = Eigen::RowVector3d::Zero();

  Positions into(const PositionsRef& positions) const;  ///< Of the mesh's space in the template's.
  Positions back(const PositionsRef& positions) const;  ///< The other way.
};

struct FitOptions {
  int surface_samples = 4000;        ///< |S|, [100, 10 million].
  int volume_samples = 4000;         ///< |V|, [0, 10 million], in 1.5 times the mesh's box, or D / 4 about it.
  double alpha = 0.3;                ///< Of eq. 1, at least 0: of the mean over V against that over S.
  int sigmas = 4;                    ///< Passes, [1, 20], their sigma from the box diagonal D
  double least_sigma = 0.2;          ///< to this part of it, geometrically. (0, 1].
  int iterations = 100;              ///< Of each pass, at least 1.
  char up = 0;                       ///< The mesh's: 'x', 'y', 'z', or 0: y or z, whichever fits better.
  bool turns = true;                 ///< Whether the mesh is tried in four directions about it.
  Eigen::VectorXd start;             ///< Parameters to begin with alone; empty: the defaults, and guesses about them.
  std::optional<TemplatePose> pose;  ///< Where it is known: kept as it is.
  unsigned seed = 1;                 ///< Of samples and guesses.
  std::shared_ptr<Backend> backend;  ///< Evaluates the field; cpu_backend() where none is given.
};

struct TemplateFit {
  Eigen::VectorXd parameters;  ///< Within their bounds.
  TemplatePose pose;
  double residual = 0;  ///< Root mean square of |f| / |grad f| over the surface, a part of D.
  double largest = 0;   ///< The largest, likewise.
  /// The other way: root mean square of the distances from the template's surface to the mesh, a part of D. Large where
  /// the template has what the mesh has not.
  double excess = 0;
  std::vector<int> at_bound;  ///< Parameters that stand at one of their bounds.
  Report report;
};

/// Minimises mean over S of f² + alpha mean over V of exp(-d² / sigma²) (f - d)², d the signed distance from the mesh,
/// by L-BFGS-B, pass by pass with falling sigma. Parts of the mesh that are not closed have no inside: there the
/// distance is compared with |f|, and a warning tells how much that is. The pose begins with the boxes' bottoms and
/// middles aligned and the same diagonals; its offset is fitted along. Several attempts are made with few samples, in
/// all directions and from several parameters, and the best of them ended with all.
///
/// Throws InvalidInput as check() does, where no triangle has an area, and for an option out of its range, and
/// Unsolvable where the template has no surface to begin with.
TemplateFit fit_template(const Template& of, const PositionsRef& positions, const TrianglesRef& triangles,
                         const FitOptions& options = {}, const ProgressFn& progress = {});

}  // namespace swage
#pragma GCC visibility pop
