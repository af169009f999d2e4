// Moves a template's parameters, and its mesh follows.
//
// Kusupati, Gaillard, Thiery, Kaiser: Semantic Shape Editing with Parametric Implicit Templates. SIGGRAPH 2024,
// section 5.
#pragma once

#include <memory>
#include <vector>

#include "swage/backend.h"
#include "swage/mesh.h"
#include "swage/report.h"
#include "swage/template.h"
#include "swage/template_fit.h"

#pragma GCC visibility push(default)
namespace swage {

struct TemplateEditOptions {
  double tracking = 1;        ///< Weight of following the template against keeping the shape, above 0.
  double smoothing = 0.1;     ///< How far neighbours' maps are joined: sigma_s as a part of D, at least 0.
  double feature_angle = 30;  ///< Degrees: neighbours are not joined across sharper edges. (0, 180].
  int sub_edits = 0;          ///< Steps on the parameters' way; 0: as many as the residual asks for.
  int passes = 1000;          ///< At most in all, at least 1.
  /// Of D: at rest are vertices that a pass moves less. (0, 1). A pass may go a part of the way only,
  /// where whole ones went to and fro: report.paths["steps"] tells.
  double tolerance = 1e-5;
  std::shared_ptr<Backend> backend;  ///< Does the local steps; cpu_backend() where none is given.
};

struct TemplateEditResult {
  Positions positions;  ///< #V × 3, mesh units, the input's order.
  double residual = 0;  ///< Mean over vertices of |f'(v') - f(v)| / |grad f'|, as a part of D.
  double largest = 0;   ///< The largest, likewise.
  /// Triangles turned by more than a right angle where what is around them is not; none that were flat. Those that
  /// their neighbours or a corner's step aside could turn back are not among them: report.paths["flips"] tells.
  int flipped = 0;
  /// Vertices that follow their neighbours instead: around triangles that turned over, or told of two sides by turns.
  int released = 0;
  Report report;
};

struct EditPlan;  ///< What is kept of a mesh between edits.

/// A mesh that follows a template which was fitted to it, by edges of a twentieth of D at most (longer ones are split
/// meanwhile, into at most 50,000 triangles more: corners alone would tell nothing of a box's sides). Prepared once,
/// with the template as it lies at rest; then moved again and again. What is found depends on the parameters asked for,
/// not on those asked for before, but for follow().
class TemplateEdit {
 public:
  /// `source`: the parameters with which the template lies in the mesh, and `pose` where (template_fit.h).
  ///
  /// Throws InvalidInput as check() does, for an option out of its range, where parameters are not as many as the
  /// template's or not finite, or the field is not finite at a vertex.
  TemplateEdit(const Template& of, const Eigen::VectorXd& source, const TemplatePose& pose,
               const PositionsRef& positions, const TrianglesRef& triangles, const TemplateEditOptions& options = {});
  ~TemplateEdit();
  TemplateEdit(TemplateEdit&&) noexcept;
  TemplateEdit& operator=(TemplateEdit&&) noexcept;

  /// What solve() would do first: false where `progress` cancelled it.
  bool prepare(const ProgressFn& progress = {});

  /// From rest to the target parameters, by sub-edits, until the mesh stands still. They may lie outside of their
  /// bounds.
  ///
  /// Throws InvalidInput where parameters are not as many as the template's or not finite.
  TemplateEditResult solve(const Eigen::VectorXd& target, const ProgressFn& progress = {});

  /// From where the last call left the mesh one sub-edit of a few passes: for a slider while it is dragged. Called
  /// again with the same target it comes closer. What the template tells nothing of, as where slats lie in a seat, goes
  /// less evenly than in solve(), whose passes a smooth warp of space goes ahead of.
  TemplateEditResult follow(const Eigen::VectorXd& target, int passes = 1);

 private:
  friend std::vector<TemplateEditResult> interpolate(TemplateEdit&, const Eigen::VectorXd&, const Eigen::VectorXd&, int,
                                                     const ProgressFn&);
  std::unique_ptr<EditPlan> plan_;
};

/// The mesh at `count` steps from the source's parameters to the target's, both included; linear in the parameters.
/// Throws as TemplateEdit does, and where there are fewer than 2. Fewer where `progress` cancelled.
std::vector<TemplateEditResult> interpolate(TemplateEdit& edit, const Eigen::VectorXd& source,
                                            const Eigen::VectorXd& target, int count, const ProgressFn& progress = {});

struct RetargetOptions {
  FitOptions source, target;  ///< Of the two fits.
  TemplateEditOptions edit;
};

struct RetargetResult {
  TemplateFit source, target;
  TemplateEditResult edit;  ///< The source with the target's parameters, where the target lies.
};

/// Fits the template to two meshes, and carries the first to the second's parameters and place.
///
/// Throws as fit_template() and TemplateEdit do, naming the mesh.
RetargetResult retarget(const Template& of, const PositionsRef& source_positions, const TrianglesRef& source_triangles,
                        const PositionsRef& target_positions, const TrianglesRef& target_triangles,
                        const RetargetOptions& options = {}, const ProgressFn& progress = {});

}  // namespace swage
#pragma GCC visibility pop
