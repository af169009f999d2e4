// All that depends on the rest shape alone.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "edit_plan.h"
#include "edit_smoothing.h"
#include "flat.h"
#include "join.h"
#include "matrices.h"
#include "preparation.h"
#include "split_edges.h"
#include "spokes_and_rims.h"
#include "stopwatch.h"
#include "swage/error.h"
#include "swage/features.h"
#include "tied_elements.h"

namespace swage {
namespace {

using Eigen::Index;

constexpr double kLongest = 0.05;            // Of D: longer edges are split.
constexpr int kMostMore = 50000;             // Triangles by splitting: it is there for meshes of few.
constexpr double kReach = 0.003;             // Of D: what is smaller follows its surroundings rather than the template.
constexpr double kWeights[2] = {1e-3, 100};  // Least and most of edges: cotangents have no bounds.
constexpr double kLeastArea = 0.01;          // Of the mean: of a vertex amid slivers.
constexpr double kGuidance = 0.1;            // Of the mesh's normals: enough where edges tell of none.
constexpr double kFactored = 0.3;            // Part of the tracking weights that is factored.

Eigen::VectorXd tracking_weights(const EditPlan& plan, const Mesh& unit_mesh) {
  const Eigen::VectorXd areas = barycentric_areas(unit_mesh.positions, unit_mesh.triangles);
  const double reach = kReach * plan.diagonal;
  return plan.options.tracking / (reach * reach) * areas.cwiseMax(kLeastArea * areas.mean());
}

std::vector<char> are_features(const EditPlan& plan, const Mesh& unit_mesh) {
  const FeatureEdges features = feature_edges(unit_mesh.positions, unit_mesh.triangles,
                                              std::numbers::pi * (1 - plan.options.feature_angle / 180));
  std::vector<char> are(static_cast<size_t>(plan.edges.vertices.rows()), 0);
  for (const auto& feature : features.rowwise()) {
    const int e = edge_between(plan.edges, feature[0], feature[1]);
    if (e >= 0) are[static_cast<size_t>(e)] = 1;
  }
  return are;
}

/// Solves the laplacian and kFactored of the tracking, as if that drew along all axes alike.
void factor(EditPlan& plan) {
  const Index count = plan.weights.size();
  HeldPoints& points = plan.about_points;
  points.soft.reserve(static_cast<size_t>(count));
  for (int v = 0; v < count; ++v)
    points.soft.push_back({{v, v, v}, Eigen::Vector3d::UnitX(), kFactored * plan.weights[v]});
  points.soft_targets = Positions::Zero(count, 3);
  points.fixed_targets.resize(0, 3);
  plan.about = std::make_unique<HeldLaplacian>(plan.system, points);
}

void sign(EditPlan& plan, const Mesh& unit_mesh) {
  FieldValues field;
  evaluate(plan, unit_mesh.positions, plan.source, FieldDerivatives::in_space, field);
  plan.rest_values = field.values;
  plan.rest_normals = vertex_normals(unit_mesh.positions, unit_mesh.triangles);
  plan.rest_gradients.setZero(field.values.size(), 3);
  plan.weights = tracking_weights(plan, unit_mesh);
  for (Index v = 0; v < field.values.size(); ++v) {
    const double slope = field.gradients.row(v).norm();
    if (slope > kNoSlope && std::isfinite(slope)) {
      plan.rest_gradients.row(v) = field.gradients.row(v) / slope;
    } else {
      plan.weights[v] = 0;
    }
  }
}

void make(EditPlan& plan, const ProgressFn& progress) {
  Preparation preparation(progress, plan.options.passes);
  const Stopwatch watch(plan.prepare_seconds);
  const Mesh unit_mesh{plan.box.into(plan.mesh.positions), plan.mesh.triangles};
  const Backend& backend = *plan.options.backend;
  plan.field = plan.of.field(backend);
  sign(plan, unit_mesh);
  plan.free_form = FreeForm(unit_mesh.positions);
  plan.is_flat = flat_triangles(unit_mesh.positions, unit_mesh.triangles);
  plan.unsplit.is_flat = flat_triangles(unit_mesh.positions, plan.unsplit.triangles);
  const std::vector<int> component = components(unit_mesh.triangles, static_cast<int>(unit_mesh.positions.rows()));
  plan.components = 1 + *std::max_element(component.begin(), component.end());
  preparation.begin("components", 0);
  // No scaffold: the template carries what is apart.
  const Joined joined = join_components(unit_mesh, plan.edges, When::never, preparation.poll());
  plan.told_components = joined.told;
  preparation.begin("elements", 0.4);
  const Positions weights = half_cotangents(unit_mesh.positions, unit_mesh.triangles, plan.is_flat)
                                .cwiseMax(kWeights[0])
                                .cwiseMin(kWeights[1]);
  plan.elements = vertex_elements(unit_mesh, weights);
  add_ties(unit_mesh.positions, joined.ties, mean_edge_length(unit_mesh.positions, unit_mesh.triangles), plan.elements);
  LocalMapStep::Rest rest;
  rest.pairs = plan.elements.pairs;
  rest.pairs.normals = plan.rest_normals;
  rest.guidance = kGuidance;
  if (plan.options.smoothing > 0) {
    join_neighbours(plan.edges, are_features(plan, unit_mesh), plan.options.smoothing * plan.diagonal, rest);
  }
  plan.local_map = backend.local_map(rest);
  if (plan.kind == EditMaps::rotated) plan.rotation = backend.rotation(plan.elements.pairs);
  preparation.begin("factor", 0.6);
  plan.system = LaplacianSystem(plan.elements.pairs);
  factor(plan);
  reset(plan);
}

void check_finite(const EditPlan& plan) {
  FieldValues field;
  plan.of.field(*plan.options.backend)->evaluate(plan.mesh.positions, plan.source, FieldDerivatives::none, field);
  for (Index v = 0; v < field.values.size(); ++v) {
    if (std::isfinite(field.values[v])) continue;
    const int vertex = plan.given ? plan.given->vertex(static_cast<int>(v)) : static_cast<int>(v);
    throw InvalidInput("TemplateEdit: the field of " + plan.of.name() + " is not finite at vertex " +
                       std::to_string(vertex) + "; are the parameters and the pose those of a fit?");
  }
}

void split_edges(EditPlan& plan, double longest, Edges edges) {
  plan.unsplit = {plan.mesh.positions.rows(), plan.mesh.triangles, std::move(edges)};
  plan.mesh = split_long_edges(plan.mesh, longest, plan.mesh.triangles.rows() + kMostMore);
  const Index more = plan.mesh.positions.rows() - plan.unsplit.vertices;
  plan.edges = more > 0 ? edges_of(plan.mesh.triangles) : plan.unsplit.edges;
  plan.told_edges = more > 0 ? "split while it follows, by " + std::to_string(more) + " vertices" : "as given";
}

}  // namespace

std::unique_ptr<EditPlan> plan_of(const Template& of, const Eigen::VectorXd& source, const TemplatePose& pose,
                                  const PositionsRef& positions, const TrianglesRef& triangles,
                                  const TemplateEditOptions& options) {
  std::unique_ptr<EditPlan> plan(new EditPlan{of, source, pose, options});
  if (!plan->options.backend) plan->options.backend = cpu_backend();
  Mesh mesh{pose.into(positions), triangles};
  const double diagonal = box_diagonal(mesh.positions);
  Surface surface = surface_given(mesh, "TemplateEdit");
  plan->counts = surface.counts;
  if (!surface.is_as_given()) plan->given.emplace(std::move(mesh), surface, false);
  plan->box = unit_box(surface.mesh.positions);
  plan->diagonal = diagonal / plan->box.extent;
  plan->mesh = std::move(surface.mesh);
  check_finite(*plan);
  split_edges(*plan, kLongest * diagonal, std::move(surface.edges));
  return plan;
}

bool prepare(EditPlan& plan, const ProgressFn& progress) {
  return prepare_once(plan, [&](EditPlan& unprepared) { make(unprepared, progress); });
}

void reset(EditPlan& plan) {
  plan.parameters = plan.source;
  plan.positions = plan.elements.pairs.vertices;
  plan.maps = identities(plan.positions.rows());
  plan.growth = 1;
  plan.warp = {};
  plan.trust.setOnes(plan.weights.size());
}

}  // namespace swage
