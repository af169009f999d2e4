// What the template tells the vertices.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "edit_plan.h"

namespace swage {
namespace {

using Eigen::Index;
using Eigen::RowVector3d;
using Eigen::Vector3d;

constexpr double kNoSlope = 1e-6;
constexpr double kNoTurn = 1e-3;
constexpr double kTurned = 0.95;  // Cosine between a normal and the last one.

Vector3d turned(const Vector3d& v, const Vector3d& from, const Vector3d& to) {
  const double cosine = from.dot(to);
  if (cosine < -0.999999) return -v;
  const Vector3d axis = from.cross(to);
  return cosine * v + axis.cross(v) + axis * (axis.dot(v) / (1 + cosine));
}

Vector3d last_normal(const EditPlan& plan, Index v) {
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> map(plan.maps.row(v).data());
  return (map * plan.rest_normals.row(v).transpose()).normalized();
}

/// Where the turns of those neighbours that did not jump take a vertex's rest normal; where all did, its last one.
Vector3d carried(const EditPlan& plan, const Tracking& tracking, const std::vector<char>& jumped, int v) {
  const Vector3d rest = plan.rest_normals.row(v);
  Vector3d sum = Vector3d::Zero();
  for (const int w : plan.rings[v]) {
    if (jumped[static_cast<size_t>(w)] == 0) sum += turned(rest, plan.rest_normals.row(w), tracking.normals.row(w));
  }
  return sum.norm() > kNoTurn ? sum.normalized() : last_normal(plan, v);
}

/// What the field suddenly turns has come across a ridge, where it tells of another part: it faces as its neighbours
/// have it.
void straighten(const EditPlan& plan, Tracking& tracking) {
  const int count = plan.rings.size();
  std::vector<char> jumped(static_cast<size_t>(count));
#pragma omp parallel for schedule(static)
  for (int v = 0; v < count; ++v) {
    const bool turns = last_normal(plan, v).dot(tracking.normals.row(v)) < kTurned;
    jumped[static_cast<size_t>(v)] = tracking.weights[v] == 0 || turns ? 1 : 0;
  }
  tracking.directions = tracking.normals;
#pragma omp parallel for schedule(static)
  for (int v = 0; v < count; ++v) {
    if (jumped[static_cast<size_t>(v)] != 0) tracking.normals.row(v) = carried(plan, tracking, jumped, v);
  }
  tracking.directions = 0.5 * (tracking.directions + tracking.normals);
}

}  // namespace

void evaluate(EditPlan& plan, const Positions& positions, const Eigen::VectorXd& parameters, FieldDerivatives how,
              FieldValues& field) {
  plan.field->evaluate(plan.box.back(positions), parameters, how, field);
  field.values /= plan.box.extent;
}

void track(EditPlan& plan, const Eigen::VectorXd& parameters) {
  Tracking& tracking = plan.tracking;
  evaluate(plan, plan.positions, parameters, FieldDerivatives::in_space, tracking.field);
  const Index count = plan.positions.rows();
  tracking.normals.resize(count, 3);
  tracking.gaps.resize(count);
  tracking.weights = plan.weights;
#pragma omp parallel for schedule(static)
  for (Index v = 0; v < count; ++v) {
    const RowVector3d gradient = tracking.field.gradients.row(v);
    const double slope = gradient.norm(), gap = (plan.rest_values[v] - tracking.field.values[v]) / slope;
    if (plan.weights[v] > 0 && slope > kNoSlope && std::isfinite(slope) && std::isfinite(gap)) {
      tracking.normals.row(v) = gradient / slope;
      tracking.gaps[v] = gap;
    } else {
      tracking.normals.row(v) = last_normal(plan, v);
      tracking.gaps[v] = tracking.weights[v] = 0;
    }
  }
  straighten(plan, tracking);
}

}  // namespace swage
