#include "targets.h"

#include <memory>
#include <utility>

#include "element_normals.h"
#include "sphere.h"

namespace swage {
namespace {

// Of so few the closest is found before a device has been asked.
constexpr Eigen::Index kFewNormals = 64;

Targets to(const StylizePlan& plan, const ClosestNormals& style) {
  const Positions normals = normalised(style.normals);
  const std::shared_ptr<Backend> backend = normals.rows() > kFewNormals ? plan.options.backend : cpu_backend();
  const std::shared_ptr<ClosestNormalStep> step = backend->closest_normal(normals);
  const auto find = [&plan, normals, step](const Positions& positions) -> Positions {
    Eigen::VectorXi closest;
    step->find(element_normals(plan, positions), closest);
    return normals(closest, Eigen::all);
  };
  return {find, style.dynamic};
}

/// #T of the surface that is solved: -1 of triangles that the caller winds the other way, else 1.
Eigen::VectorXd sides(const StylizePlan& plan) {
  const Mesh& mesh = plan.given->mesh();
  const Triangles triangles = mesh.triangles(plan.given->triangles(), Eigen::all);
  const Positions here = area_vectors(plan.mesh.positions, plan.mesh.triangles);
  const Eigen::VectorXd along = here.cwiseProduct(area_vectors(mesh.positions, triangles)).rowwise().sum();
  return along.unaryExpr([](double x) { return x < 0 ? -1.0 : 1.0; });
}

/// The given's, of the elements of the surface that is solved.
Positions of_elements(const StylizePlan& plan, const GivenNormals& style) {
  Positions normals = normalised(style.normals);
  if (plan.given) {
    normals = Positions(normals(style.of_triangles ? plan.given->triangles() : plan.given->vertices(), Eigen::all));
    if (style.of_triangles) normals.array().colwise() *= sides(plan).array();
  }
  if (style.of_triangles == plan.of_triangles()) return normals;
  const Triangles& triangles = plan.mesh.triangles;
  if (style.of_triangles) {
    const Eigen::VectorXd areas = area_vectors(plan.elements.pairs.vertices, triangles).rowwise().norm();
    normals = sums_around(plan, areas.asDiagonal() * normals);
  } else {
    normals = Positions(normals(triangles.col(0), Eigen::all) + normals(triangles.col(1), Eigen::all) +
                        normals(triangles.col(2), Eigen::all));
  }
  return normalised(std::move(normals));
}

Targets to(const StylizePlan& plan, const GivenNormals& style) {
  return {[&](const Positions&) { return of_elements(plan, style); }, false};
}

Targets to(const StylizePlan& plan, const SphereMap& style) {
  return {[&](const Positions&) { return on_sphere(style, plan.elements.pairs.normals, *plan.options.backend); },
          false};
}

Targets to(const StylizePlan& plan, const Developable& style) {
  const std::shared_ptr<NormalFitStep> step = normal_fit_of(plan);
  const double least_part = style.threshold > 0 ? 0 : style.tau * mean_second_spread(plan, *step);
  const auto find = [&plan, &style, step, least_part](const Positions& positions) {
    Positions of_triangles = developable_normals(plan, *step, style, least_part, positions);
    if (plan.of_triangles()) return of_triangles;
    const Eigen::VectorXd areas = area_vectors(positions, plan.mesh.triangles).rowwise().norm();
    return normalised(sums_around(plan, areas.asDiagonal() * of_triangles));
  };
  return {find, true};
}

}  // namespace

GivenNormals as_given(const StylizePlan& plan, const Positions& targets) {
  if (!plan.given) return {targets, plan.of_triangles()};
  const Mesh& mesh = plan.given->mesh();
  if (!plan.of_triangles()) return {plan.given->back_vertices(targets), false};
  GivenNormals given{Positions::Zero(mesh.triangles.rows(), 3), true};
  given.normals(plan.given->triangles(), Eigen::all) = (targets.array().colwise() * sides(plan).array()).matrix();
  return given;
}

Targets targets_of(const StylizePlan& plan, const Style& style) {
  return std::visit([&](const auto& one) { return to(plan, one); }, style);
}

}  // namespace swage
