// The local step: for each element the rotation, and for acap the scale, that fit the edges and the normal best.
#include <algorithm>
#include <cmath>

#include "matrices.h"
#include "plan.h"

namespace swage {
namespace {

using Matrix = Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;

// Scales below count as this: the weight that divides by them stays finite.
constexpr double kSmallest = 1e-6;

bool has_scale(const StylizePlan& plan) { return plan.options.energy == StylizeEnergy::acap; }

/// The formula of appendix C as the authors' program has it: n unrotated above, and |n|² for n · t below.
void scale_as_paper(const StylizePlan& plan, const Positions& positions, const Positions& targets, double lambda,
                    StylizeFit& fitted) {
  const PairsRest& rest = plan.elements.pairs;
#pragma omp parallel for schedule(static)
  for (Eigen::Index n = 0; n < fitted.scales.size(); ++n) {
    Matrix rotation(fitted.matrices.row(n).data());
    const double normals = lambda * rest.normal_weights[n];
    double above = normals * rest.normals.row(n).dot(targets.row(n)), below = normals;
    const auto at = static_cast<size_t>(n);
    for (int p = rest.offsets[at]; p < rest.offsets[at + 1]; ++p) {
      const int i = rest.pairs(p, 0), j = rest.pairs(p, 1);
      const Eigen::RowVector3d before = rest.vertices.row(j) - rest.vertices.row(i);
      const Eigen::RowVector3d now = positions.row(j) - positions.row(i);
      above += rest.weights[p] * now.dot(before * rotation.transpose());
      below += rest.weights[p] * before.squaredNorm();
    }
    fitted.scales[n] = below == 0 ? 1 : above / below;
    rotation *= fitted.scales[n];
  }
}

}  // namespace

std::unique_ptr<StylizeSteps> steps_of(const StylizePlan& plan) {
  auto steps = std::make_unique<StylizeSteps>();
  const Backend& backend = *plan.options.backend;
  if (has_scale(plan) && plan.options.scale == AcapScale::exact) {
    steps->similarity = backend.similarity(plan.elements.pairs);
  } else {
    steps->rotation = backend.rotation(plan.elements.pairs);
  }
  return steps;
}

std::unique_ptr<NormalFitStep> normal_fit_of(const StylizePlan& plan) {
  NormalFitStep::Rest rest;
  rest.triangle_count = static_cast<int>(plan.mesh.triangles.rows());
  rest.offsets.push_back(0);
  for (int v = 0; v < static_cast<int>(plan.mesh.positions.rows()); ++v) {
    for (const int t : plan.triangles_around[v]) rest.triangles.push_back(t);
    rest.offsets.push_back(static_cast<int>(rest.triangles.size()));
  }
  return plan.options.backend->normal_fit(rest);
}

StylizeFit unmoved(Eigen::Index element_count) {
  return {identities(element_count), Eigen::VectorXd::Ones(element_count)};
}

void fit(const StylizePlan& plan, StylizeSteps& steps, const Positions& positions, const Positions& targets,
         double lambda, StylizeFit& fitted) {
  // A target's length multiplies its weight (steps.h): nothing prepared depends on lambda. Of s R the rotation that is
  // best for the scale before has s times the edges' part, so that the energy falls in it and then in the scale.
  Positions weighted = lambda * targets;
  if (steps.similarity) {
    weighted.array().colwise() /= fitted.scales.array().max(kSmallest);
    steps.similarity->fit(positions, weighted, fitted.matrices);
    fitted.scales = fitted.matrices.leftCols(3).rowwise().norm();
    return;
  }
  steps.rotation->fit(positions, weighted, fitted.matrices);
  if (has_scale(plan)) scale_as_paper(plan, positions, targets, lambda, fitted);
}

}  // namespace swage
