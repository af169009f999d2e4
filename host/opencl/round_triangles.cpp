#include "round_triangles.h"

#include <Eigen/Geometry>

namespace swage {
namespace {

using Eigen::Index;
using RestRow = Eigen::Matrix<double, 1, RoundTriangles::kAll>;

RestRow rest_row(const TransformStep::Rest& rest, Index triangle) {
  Eigen::Matrix3d sides;  // A row each.
  for (int k = 0; k < 3; ++k) {
    sides.row(k) =
        rest.vertices.row(rest.triangles(triangle, (k + 1) % 3)) - rest.vertices.row(rest.triangles(triangle, k));
  }
  const Eigen::RowVector3d lengths = sides.rowwise().norm();
  sides.rowwise().normalize();
  RestRow row;
  row.head<3>() = sides.row(1).cross(sides.row(0)).normalized();
  for (int k = 0; k < 3; ++k) {
    const Eigen::RowVector3d toward_next = sides.row(k), toward_last = -sides.row((k + 2) % 3);
    row[3 + k] = toward_last.dot(toward_next);
    row[6 + k] = toward_last.cross(toward_next).norm();
    row.segment<3>(9 + 3 * k) = toward_next;
  }
  row[18] = rest.sphericities[triangle];
  row.tail<3>() = lengths.cwiseInverse();
  return row;
}

}  // namespace

RoundTriangles round_triangles(const TransformStep::Rest& rest) {
  const Index count = (rest.sphericities.array() != 0).count();
  RoundTriangles round{Eigen::VectorXi(count), {}, {}};
  Index i = 0;
  for (int t = 0; t < rest.triangles.rows(); ++t) {
    if (rest.sphericities[t] != 0) round.triangles[i++] = t;
  }
  round.corners = rest.triangles(round.triangles, Eigen::all);
  round.rest.resize(count, RoundTriangles::kAll);
  for (i = 0; i < count; ++i) round.rest.row(i) = rest_row(rest, round.triangles[i]);
  return round;
}

}  // namespace swage
