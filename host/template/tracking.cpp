// What the template tells the vertices.
#include <algorithm>
#include <cmath>

#include "edit_plan.h"

namespace swage {

using Eigen::Index;
using Eigen::Vector3d;

void evaluate(EditPlan& plan, const Positions& positions, const Eigen::VectorXd& parameters, FieldDerivatives how,
              FieldValues& field) {
  plan.field->evaluate(plan.box.back(positions), parameters, how, field);
  field.values /= plan.box.extent;
}

void track(EditPlan& plan, const Eigen::VectorXd& parameters) {
  Tracking& tracking = plan.tracking;
  evaluate(plan, plan.positions, parameters, FieldDerivatives::in_space, tracking.field);
  const Index count = plan.positions.rows();
  tracking.gradients.resize(count, 3);
  tracking.gaps.resize(count);
  tracking.weights = plan.weights.cwiseProduct(plan.trust);
#pragma omp parallel for schedule(static)
  for (Index v = 0; v < count; ++v) {
    const double slope = tracking.field.gradients.row(v).norm();
    const double gap = (plan.growth * plan.rest_values[v] - tracking.field.values[v]) / slope;
    if (tracking.weights[v] > 0 && slope > kNoSlope && std::isfinite(slope) && std::isfinite(gap)) {
      tracking.gradients.row(v) = tracking.field.gradients.row(v) / slope;
      tracking.gaps[v] = gap;
    } else {
      tracking.gradients.row(v).setZero();
      tracking.gaps[v] = tracking.weights[v] = 0;
    }
  }
  aim(plan);
}

void aim(EditPlan& plan) {
  Tracking& tracking = plan.tracking;
  tracking.directions.resize(plan.positions.rows(), 3);
#pragma omp parallel for schedule(static)
  for (Index v = 0; v < plan.positions.rows(); ++v) {
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> map(plan.maps.row(v).data());
    const Vector3d carried = (map * plan.rest_gradients.row(v).transpose()).stableNormalized();
    tracking.directions.row(v) = 0.5 * (tracking.gradients.row(v) + carried.transpose());
  }
}

}  // namespace swage
