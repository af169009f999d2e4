// The carry step: slippage, cells and carried vertices, by every backend.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "adjacency.h"
#include "carried.h"
#include "clipped.h"
#include "measures.h"
#include "opencl_device.h"
#include "shapes.h"
#include "sides.h"
#include "swage/error.h"

namespace swage {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::RowVector3d;

struct Who {
  const char* name;
  std::shared_ptr<Backend> (*backend)();
};

const Who kWho[] = {{"cpu", [] { return cpu_backend(); }},
                    {"opencl_single", [] { return test::opencl_or_skip(Precision::single); }},
                    {"opencl_double", [] { return test::opencl_or_skip(Precision::twice); }}};

class CarryStepBy : public testing::TestWithParam<Who> {
 protected:
  void SetUp() override { backend_ = GetParam().backend(); }

  std::unique_ptr<CarryStep> step(const Mesh& mesh) const { return backend_->carry(test::carried_rest(mesh)); }

  AxisValues slippage(const Mesh& mesh) const {
    AxisValues means;
    step(mesh)->slippage({0, mesh.triangles.rows()}, means);
    return means;
  }

  std::shared_ptr<Backend> backend_;
};

/// The definition, by edges.
AxisValues expected_slippage(const Mesh& mesh) {
  const Edges edges = edges_of(mesh.triangles);
  const Positions normals = unit_normals(mesh.positions, mesh.triangles);
  AxisValues means(normals.rows(), 3);
  for (int t = 0; t < normals.rows(); ++t) {
    RowVector3d sum = RowVector3d::Zero();
    double weights = 0;
    for (const int e : edges.triangle_edges.row(t)) {
      const double length = edge_vectors(mesh.positions, edges).row(e).norm();
      for (const int other : edges.triangles[e]) {
        const RowVector2i edge = edges.vertices.row(e);
        const bool alike = runs_along(mesh.triangles, t, edge) != runs_along(mesh.triangles, other, edge);
        const double cosine = normals.row(t).dot(normals.row(other)) * (other == t || alike ? 1 : -1);
        sum += length * std::max(0.0, cosine) * normals.row(other).cwiseAbs();
        weights += length * std::max(0.0, cosine);
      }
    }
    means.row(t) = sum / weights;
  }
  return means;
}

}  // namespace
}  // namespace swage
