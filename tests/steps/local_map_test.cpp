// The local_map step: what its maps must be, by every backend.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "adjacency.h"
#include "measures.h"
#include "opencl_device.h"
#include "shapes.h"
#include "spokes_and_rims.h"
#include "swage/backend.h"

namespace swage {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;

struct Who {
  const char* name;
  std::shared_ptr<Backend> (*backend)();
  double tolerance;
};

const Who kWho[] = {
    {"cpu", [] { return cpu_backend(); }, 1e-10},
    {"opencl_single", [] { return test::opencl_or_skip(Precision::single); }, 2e-4},
    {"opencl_double", [] { return test::opencl_or_skip(Precision::twice); }, 1e-10},
};

LocalMapStep::Rest rest_of(const Mesh& mesh, double smoothing) {
  LocalMapStep::Rest rest;
  rest.pairs = vertex_elements(mesh, Positions::Ones(mesh.triangles.rows(), 3)).pairs;
  rest.pairs.normals = vertex_normals(mesh.positions, mesh.triangles);
  if (smoothing == 0) return rest;
  const Lists rings = one_rings(edges_of(mesh.triangles), static_cast<int>(mesh.positions.rows()));
  rest.offsets = rings.offsets;
  rest.neighbours = rings.items;
  rest.smoothing = Eigen::VectorXd::Constant(static_cast<Index>(rings.items.size()), smoothing);
  return rest;
}

Matrix3d map_of(const Transforms& maps, Index i) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(maps.row(i).data());
}

Mesh bent_of(Mesh mesh) {
  for (Index v = 0; v < mesh.positions.rows(); ++v) {
    mesh.positions(v, 2) += 0.4 * std::sin(2 * mesh.positions(v, 0));
    mesh.positions(v, 1) *= 1.7;
  }
  return mesh;
}

Transforms identities(Index count) {
  return Eigen::Matrix<double, 1, 9>(1, 0, 0, 0, 1, 0, 0, 0, 1).replicate(count, 1);
}

/// What the best map with a normal leaves of the sum that guidance makes the least, by plain least squares: of the
/// plane's two axes the images that minimise it, across the normal.
double left_over(const LocalMapStep::Rest& rest, const Positions& positions, const Positions& guides, Index v,
                 const Eigen::Vector3d& normal) {
  const auto at = static_cast<size_t>(v);
  const Eigen::Vector3d n = rest.pairs.normals.row(v), u = n.unitOrthogonal(), w = n.cross(u);
  const Matrix3d across = Matrix3d::Identity() - normal * normal.transpose();
  std::vector<Eigen::Vector2d> from;  // In the plane, weighted.
  std::vector<Eigen::Vector3d> to;    // What is left once the normal's part is taken off.
  double guided = 0;
  for (int p = rest.pairs.offsets[at]; p < rest.pairs.offsets[at + 1]; ++p) {
    const int first = rest.pairs.pairs(p, 0), second = rest.pairs.pairs(p, 1);
    const Eigen::Vector3d a = rest.pairs.vertices.row(second) - rest.pairs.vertices.row(first);
    const Eigen::Vector3d b = positions.row(second) - positions.row(first);
    const double root = std::sqrt(rest.pairs.weights[p]);
    from.emplace_back(root * a.dot(u), root * a.dot(w));
    to.emplace_back(root * (b - a.dot(n) * normal));
    guided += rest.guidance * from.back().squaredNorm();
  }
  const double sum = guided * (normal - guides.row(v).transpose()).squaredNorm();
  Eigen::MatrixXd left(from.size(), 2), right(from.size(), 3);
  for (size_t k = 0; k < from.size(); ++k) {
    left.row(static_cast<Index>(k)) = from[k];
    right.row(static_cast<Index>(k)) = to[k];
  }
  const Eigen::MatrixXd images = left.colPivHouseholderQr().solve(right * across);
  return sum + (right - left * images).squaredNorm();
}

class LocalMapStepBy : public testing::TestWithParam<Who> {
 protected:
  void SetUp() override { backend_ = GetParam().backend(); }

  Transforms fitted(const Mesh& mesh, const Positions& positions, const Positions& normals, double smoothing,
                    Transforms last) const {
    backend_->local_map(rest_of(mesh, smoothing))->fit(positions, normals, last);
    return last;
  }

  std::shared_ptr<Backend> backend_;
};

/// Of a plane stretched, sheared and turned they are that, and the turn of its normal.
TEST_P(LocalMapStepBy, IsTheMapOfAPlane) {
  if (!backend_) return;
  const Mesh mesh = test::sheet(6);
  Matrix3d stretch = Matrix3d::Identity();
  stretch(0, 0) = 2;
  stretch(0, 1) = 0.3;
  const Matrix3d turn = Eigen::AngleAxisd(0.8, Eigen::Vector3d(1, 2, 0.5).normalized()).toRotationMatrix();
  const Matrix3d map = turn * stretch;
  const Positions positions = (mesh.positions * map.transpose()).rowwise() + Eigen::RowVector3d(3, -1, 2);
  const Positions normals = (vertex_normals(mesh.positions, mesh.triangles) * turn.transpose()).eval();
  for (const double smoothing : {0.0, 0.1}) {
    Transforms maps = identities(mesh.positions.rows());
    // Neighbours follow, and smoothing keeps what is the same everywhere.
    for (int pass = 0; pass < (smoothing > 0 ? 200 : 1); ++pass)
      maps = fitted(mesh, positions, normals, smoothing, maps);
    for (Index v = 0; v < maps.rows(); ++v) {
      EXPECT_LT((map_of(maps, v) - map).norm(), (smoothing > 0 ? 1e-4 : 0) + 10 * GetParam().tolerance) << v;
    }
  }
}

/// Whatever becomes of the surface: the rest normal goes to the new one, and the plane across it to that across.
TEST_P(LocalMapStepBy, TakesNormalsToNormals) {
  if (!backend_) return;
  const Mesh mesh = test::torus();
  const Mesh bent = bent_of(mesh);
  const Positions before = vertex_normals(mesh.positions, mesh.triangles),
                  after = vertex_normals(bent.positions, bent.triangles);
  for (const double smoothing : {0.0, 0.05}) {
    const Transforms maps = fitted(mesh, bent.positions, after, smoothing, identities(mesh.positions.rows()));
    for (Index v = 0; v < maps.rows(); ++v) {
      const Matrix3d map = map_of(maps, v);
      const Eigen::Vector3d n = before.row(v), now = after.row(v);
      EXPECT_LT((map * n - now).norm(), 10 * GetParam().tolerance);
      EXPECT_LT((now.transpose() * map - n.transpose()).norm(), 10 * GetParam().tolerance);
    }
  }
}

/// Smoothing without a surface to fit carries neighbours' maps over, turned along.
TEST_P(LocalMapStepBy, CarriesNeighboursAlong) {
  if (!backend_) return;
  const Mesh mesh = test::sphere(1, 2);
  const Positions normals = vertex_normals(mesh.positions, mesh.triangles);
  const Matrix3d turn = Eigen::AngleAxisd(1.1, Eigen::Vector3d(0.3, 1, -0.4).normalized()).toRotationMatrix();
  const Positions positions = mesh.positions * turn.transpose(), turned = normals * turn.transpose();
  const Transforms last = turn.reshaped<Eigen::RowMajor>().transpose().replicate(mesh.positions.rows(), 1);
  const Transforms maps = fitted(mesh, positions, turned, 10, last);
  for (Index v = 0; v < maps.rows(); ++v) EXPECT_LT((map_of(maps, v) - turn).norm(), 20 * GetParam().tolerance) << v;
}

/// With guidance, normals are those that leave least of what the maps are fitted to: no other does better.
TEST_P(LocalMapStepBy, TurnsNormalsToFitBest) {
  if (!backend_) return;
  const Mesh mesh = test::torus();
  const Mesh bent = bent_of(mesh);
  const Positions guides = vertex_normals(bent.positions, bent.triangles);
  for (const double smoothing : {0.0, 0.05}) {
    LocalMapStep::Rest rest = rest_of(mesh, smoothing);
    rest.guidance = 0.1;
    const Transforms last = identities(mesh.positions.rows());
    Transforms maps = last;
    backend_->local_map(rest)->fit(bent.positions, guides, maps);
    for (Index v = 0; v < maps.rows(); v += 7) {
      const Eigen::Vector3d n = rest.pairs.normals.row(v), found = map_of(maps, v) * n;
      EXPECT_NEAR(found.norm(), 1, GetParam().tolerance);
      const double least = left_over(rest, bent.positions, guides, v, found);
      for (const Eigen::Vector3d& aside : {Eigen::Vector3d(0.02, 0, 0), {0, 0.02, 0}, {0, 0, 0.02}}) {
        for (const double sign : {-1.0, 1.0}) {
          const Eigen::Vector3d other = (found + sign * aside).normalized();
          EXPECT_LE(least, left_over(rest, bent.positions, guides, v, other) * (1 + GetParam().tolerance)) << v;
        }
      }
      EXPECT_LT(least, left_over(rest, bent.positions, guides, v, -found));
    }
  }
}

/// Where the surface has only turned they are its own, whatever the guidance.
TEST_P(LocalMapStepBy, LeavesNormalsThatFit) {
  if (!backend_) return;
  const Mesh mesh = test::sphere(1, 2);
  const Matrix3d turn = Eigen::AngleAxisd(1.1, Eigen::Vector3d(0.3, 1, -0.4).normalized()).toRotationMatrix();
  const Positions positions = mesh.positions * turn.transpose();
  for (const double guidance : {1e-3, 1.0, 1e3}) {
    LocalMapStep::Rest rest = rest_of(mesh, 0);
    rest.guidance = guidance;
    Transforms maps;
    backend_->local_map(rest)->fit(positions, rest.pairs.normals * turn.transpose(), maps);
    for (Index v = 0; v < maps.rows(); ++v) EXPECT_LT((map_of(maps, v) - turn).norm(), 20 * GetParam().tolerance);
  }
}

TEST_P(LocalMapStepBy, RefusesOtherRows) {
  if (!backend_) return;
  const Mesh mesh = test::sheet(2);
  const auto step = backend_->local_map(rest_of(mesh, 0));
  Transforms maps;
  EXPECT_THROW(step->fit(Positions::Zero(2, 3), vertex_normals(mesh.positions, mesh.triangles), maps), InvalidInput);
  EXPECT_THROW(step->fit(mesh.positions, Positions::Zero(2, 3), maps), InvalidInput);
}

INSTANTIATE_TEST_SUITE_P(Backends, LocalMapStepBy, testing::ValuesIn(kWho),
                         [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace swage
