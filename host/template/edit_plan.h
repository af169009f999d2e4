// What a prepared edit keeps, and the verbs that it is told in.
//
// Each pass minimises, for the vertices' displacements d in the unit box,
//   sum over vertices v and the edges (u, w) around them of c |d_w - d_u - J_v (w - u) + (w' - u')|²   (paper eq. 10)
//   + sum over vertices of m_v (a_v . d_v - (f_v - f'(v')) / |grad f'|)²                               (eq. 8)
// with the maps J_v of the local_map step, which take the mesh's rest normal to that now, and a_v the mean of the
// directions of grad f' and J_v grad f. Long edges have been split: corners of a box are on its surface wherever its
// sides go, and only what lies amid the sides is told of it. Normals now are those that leave the first sum least, near
// the mesh's. The field's, or the mesh's alone, are not what the sum asks for: where those bend within less than an
// edge, or triangles are slivers, each pass would turn them farther than the vertices that they move.
//
// In solve() a smooth warp of space, the free form nearest to what tracking asks for, goes ahead in each sub-edit, and
// within the surface a small part of J_v is the warp's: what slides along the template is told of nothing else.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "adjacency.h"
#include "cancel.h"
#include "conjugate_gradients.h"
#include "element_list.h"
#include "free_form.h"
#include "given.h"
#include "laplacian_system.h"
#include "measures.h"
#include "swage/template_edit.h"

namespace swage {

constexpr double kNoSlope = 1e-6;  // Of |grad f|: below, the field tells nothing.

/// How neighbourhoods are mapped: as the paper's local_map step does or, to measure what that is better than, by the
/// closest rotations.
enum class EditMaps { stretched, rotated };

/// The mesh before its edges were split, whose vertices are the first ones since.
struct Unsplit {
  Eigen::Index vertices = 0;
  Triangles triangles = {};
  Edges edges = {};
  std::vector<char> is_flat = {};  ///< A triangle each.
};

/// What a pass follows, a row or entry a vertex.
struct Tracking {
  FieldValues field;        ///< In the unit box, whose unit its values have.
  Positions gradients;      ///< grad f' / |grad f'|
  Positions directions;     ///< a_v
  Eigen::VectorXd gaps;     ///< (f_v - f') / |grad f'|, f_v grown along
  Eigen::VectorXd weights;  ///< m_v as trusted: 0 where the field tells nothing.
};

/// Columns t, w, s of displacements t + w × x + s x, about a middle, that tracking is told nothing of: a turn about the
/// axis of a template that is round.
using IdleMotions = Eigen::Matrix<double, 7, Eigen::Dynamic, Eigen::ColMajor, 7, 7>;

/// A smooth warp of space that has taken the mesh along: what the template does not tell of, sliding along its surface
/// above all, goes with what is around it.
struct Warp {
  Positions control = {};  ///< Displacements, summed up, of the free form's control points,
  Transforms maps = {};    ///< and what they do at the vertices; empty where none is held.
};

struct EditPlan {
  Template of;
  Eigen::VectorXd source;
  TemplatePose pose;
  TemplateEditOptions options;
  EditMaps kind = EditMaps::stretched;
  std::optional<Given> given = {};  ///< Where what follows is not as given.
  Mesh mesh = {};                   ///< In the template's space, long edges split.
  Edges edges = {};
  std::string told_edges = {};
  Unsplit unsplit = {};
  SurfaceCounts counts = {};
  UnitBox box = {};
  double diagonal = 0;  ///< D in the unit box, of the mesh as given.

  // Filled by prepare().
  std::unique_ptr<FieldStep> field = {};
  std::unique_ptr<LocalMapStep> local_map = {};
  std::unique_ptr<RotationStep> rotation = {};
  Elements elements = {};  ///< One a vertex, in the unit box.
  LaplacianSystem system = {};
  std::unique_ptr<HeldLaplacian> about = {};  ///< The laplacian and a part of all tracking weights, factored.
  HeldPoints about_points = {};
  Eigen::VectorXd rest_values = {};  ///< f_v
  Positions rest_gradients = {};     ///< grad f / |grad f|
  Positions rest_normals = {};       ///< Of the mesh.
  Eigen::VectorXd weights = {};      ///< m_v of vertices at which the field is known.
  std::vector<char> is_flat = {};    ///< A triangle each.
  FreeForm free_form = {};
  int components = 1;
  std::string told_components = "one";
  double prepare_seconds = 0;
  bool prepared = false;
  std::mutex preparing = {};

  // Where the last call left the mesh.
  Eigen::VectorXd parameters = {};
  Positions positions = {};
  Transforms maps = {};
  Eigen::VectorXd trust = {};  ///< Parts of m_v: less where the template asks for what the mesh cannot do.
  double growth = 1;           ///< Of the template as a whole: what lies off its surface grows along.
  Tracking tracking = {};
  Warp warp = {};
  IdleMotions idle = {};
  Eigen::RowVector3d idle_about = Eigen::RowVector3d::Zero();
  GradientsWork<Eigen::VectorXd> work = {};
};

// edit_check.cpp
void check_options(const TemplateEditOptions& options);
void check_parameters(const Template& of, const Eigen::VectorXd& parameters, const char* called);

// edit_prepare.cpp
std::unique_ptr<EditPlan> plan_of(const Template& of, const Eigen::VectorXd& source, const TemplatePose& pose,
                                  const PositionsRef& positions, const TrianglesRef& triangles,
                                  const TemplateEditOptions& options);
/// Once. False where `progress` cancelled: another call begins anew.
bool prepare(EditPlan& plan, const ProgressFn& progress);
/// The mesh is as it was at first.
void reset(EditPlan& plan);

// tracking.cpp
/// The field and its gradients in the unit box.
void evaluate(EditPlan& plan, const Positions& positions, const Eigen::VectorXd& parameters, FieldDerivatives how,
              FieldValues& field);
/// Of where the mesh is, with the maps that it has.
void track(EditPlan& plan, const Eigen::VectorXd& parameters);
/// The directions of tracking, once the maps are others.
void aim(EditPlan& plan);

// edit_whole.cpp
/// Moves, turns and scales the whole mesh where that is most of what it has to do. Whether it did.
bool move_as_whole(EditPlan& plan);
/// Of where the mesh is: the idle motions, and their displacements of the vertices, each of mean square 1.
void find_idle(EditPlan& plan);
std::vector<Positions> idle_displacements(const EditPlan& plan);
/// Takes the idle motions, as last found, out of a pass's displacements: passes would drift along.
void stay(const EditPlan& plan, Positions& moved);
/// Moves the mesh to where the target's template is where that is the source's, moved, turned and scaled. False, and
/// nothing has moved, where it is not.
bool follow_as_whole(EditPlan& plan, const Eigen::VectorXd& target, const Poll& poll);

// edit_warp.cpp
/// Warps space where that is most of what tracking asks for on the way to the parameters. Whether it did. `behind` are
/// the gaps of before: where the mesh did not follow, less is asked of it.
bool warp(EditPlan& plan, const Eigen::VectorXd& parameters, const Eigen::VectorXd& behind);
/// Within the surface maps become the warp's by a small part: what slides goes with what is around it.
void lean_on_warp(EditPlan& plan);

// edit_trust.cpp
/// The triangles that face against where their corners' maps take their rest normal, but those flat at rest.
std::vector<int> folded(const EditPlan& plan);
/// Of `triangles` their rest area vectors, but where all around turned them by more than a right angle as that left
/// them.
Positions faced(const EditPlan& plan, const Triangles& triangles);
/// Of `triangles` those that face against that, but those flat at rest.
std::vector<int> flipped(const EditPlan& plan, const Triangles& triangles, const std::vector<char>& is_flat);
/// Of each vertex whether it is of `triangles` or in as many rings around them.
std::vector<char> around(const EditPlan& plan, const std::vector<int>& triangles, int rings);
/// What the template asks of the vertices as many rings around them they cannot do: they go with their neighbours.
void distrust(EditPlan& plan, const std::vector<int>& triangles, int rings);
/// Likewise of vertices that now are on another side of the template than with the last pass's `gradients`: where it
/// has become thinner than they lie deep in it, there is no place that it asks for.
void distrust_opposed(EditPlan& plan, const Positions& gradients);

/// What the template asks of those `inside` counts next to nothing from now on.
void let_go(EditPlan& plan, const std::vector<char>& inside);

// edit_heal.cpp
/// Turns back what is over in the end, whatever the template asks for: folds go with what is around them, corners of
/// slivers aside. Nothing moves where nothing is. Tells in words what it did.
std::string heal(EditPlan& plan);

// follow.cpp
/// Of where the mesh is.
void fit_maps(EditPlan& plan);
/// Of conjugate gradients in a pass: until the mesh stands still, and while it is dragged.
constexpr int kSettling = 15, kDragging = 6;
/// Moves the mesh by one pass, `part` of the way, and returns how far it moved a vertex at most.
double pass(EditPlan& plan, const Eigen::VectorXd& parameters, int iterations, double part = 1);
/// From where the mesh is to the target until it stands still.
Report advance(EditPlan& plan, const Eigen::VectorXd& target, const ProgressFn& progress);
/// Where the mesh is.
TemplateEditResult result_of(EditPlan& plan, const Eigen::VectorXd& target, Report report);

}  // namespace swage
