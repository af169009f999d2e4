// Edits of a surface carried to what hangs on it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#ifdef _OPENMP
#include <omp.h>
#endif

#include "decimate.h"
#include "measures.h"
#include "places.h"
#include "points_near.h"
#include "rays_embree.h"
#include "shapes.h"
#include "swage/error.h"
#include "swage/mesh_io.h"
#include "swage/transfer.h"

namespace swage {
namespace {

using Eigen::Matrix3d;
using Eigen::RowVector3d;
using Eigen::Vector3d;
using testing::HasSubstr;

class Carry : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_embree()) GTEST_SKIP() << "this build has no Embree";
  }
};

Positions mapped(const Positions& positions, const Matrix3d& linear, const RowVector3d& shift) {
  return (positions * linear.transpose()).rowwise() + shift;
}

Transforms everywhere(const Matrix3d& linear, Eigen::Index count) {
  return Eigen::Matrix<double, 1, 9>(linear.reshaped<Eigen::RowMajor>().transpose()).replicate(count, 1);
}

double largest_difference(const Positions& a, const Positions& b) { return (a - b).rowwise().norm().maxCoeff(); }

/// What points near a mesh become when it moves.
Positions carried(const Positions& points, const Mesh& mesh, const Positions& moved,
                  const Transforms* transforms = nullptr) {
  const Attachments attachments = attach(points, mesh.positions, mesh.triangles);
  return carry(attachments, mesh.triangles, mesh.positions, moved, transforms);
}

std::vector<Mesh> shapes() {
  Mesh needles = test::box({1, 1, 1e-9}, 3);
  return {test::bumpy_sphere(3), test::torus(), test::box({2, 1, 0.01}, 4), test::sheet(), needles};
}

TEST_F(Carry, WhatDidNotMoveStays) {
  for (const Mesh& mesh : shapes()) {
    for (const double distance : {0.0, 1.0, 30.0}) {
      const Positions points = test::points_near(mesh, 500, distance);
      const double box = std::max(box_diagonal(mesh.positions), box_diagonal(points));
      EXPECT_LT(largest_difference(carried(points, mesh, mesh.positions), points), 1e-12 * box);
    }
  }
}

TEST_F(Carry, AffineMapsAreCarriedExactly) {
  const Matrix3d linear{{1.3, 0.2, -0.4}, {0.1, 0.7, 0.3}, {0.5, -0.6, 1.9}};
  const RowVector3d shift(4, -5, 6);
  for (const Mesh& mesh : shapes()) {
    const Transforms transforms = everywhere(linear, mesh.triangles.rows());
    for (const double distance : {0.0, 1.0, 10.0}) {
      const Positions points = test::points_near(mesh, 500, distance);
      const Positions moved = mapped(mesh.positions, linear, shift);
      EXPECT_LT(largest_difference(carried(points, mesh, moved, &transforms), mapped(points, linear, shift)), 1e-13);
    }
  }
}

TEST_F(Carry, RotationAndScaleTakeOffsetsAlongByThemselves) {
  const Matrix3d linear = 2.5 * Eigen::AngleAxisd(1.1, Vector3d(1, 2, -3).normalized()).toRotationMatrix();
  const RowVector3d shift(-1, 7, 2);
  for (const Mesh& mesh : {test::bumpy_sphere(3), test::torus(), test::box({2, 1, 0.3}, 4), test::sheet()}) {
    const Positions points = test::points_near(mesh, 500, 2);
    const Positions found = carried(points, mesh, mapped(mesh.positions, linear, shift));
    EXPECT_LT(largest_difference(found, mapped(points, linear, shift)), 1e-12);
  }
}

TEST_F(Carry, AStretchedSheetLiftsOffsetsByItsMeanStretch) {
  const Mesh sheet = test::sheet(5);
  Positions points(2, 3), due(2, 3);
  points << 0.37, 0.61, 0.2, 1.1, 0.3, -0.5;
  due << 4 * 0.37, 0.61, 2 * 0.2, 4 * 1.1, 0.3, 2 * -0.5;
  const Positions moved = sheet.positions * Vector3d(4, 1, 1).asDiagonal();
  EXPECT_LT(largest_difference(carried(points, sheet, moved), due), 1e-14);
}

TEST_F(Carry, TrianglesWithoutAreaLeaveOffsetsAsTheyAre) {
  Mesh line{Positions(3, 3), Triangles(1, 3)};
  line.positions << 0, 0, 0, 1, 0, 0, 2, 0, 0;
  line.triangles << 0, 1, 2;
  const Positions points = RowVector3d(0.5, 0.3, 0.1);
  const Positions swung = mapped(line.positions, Eigen::AngleAxisd(1, Vector3d::UnitZ()).toRotationMatrix(), {0, 0, 0});
  const Positions found = carried(points, line, swung);
  const RowVector3d foot(0.5 * std::cos(1), 0.5 * std::sin(1), 0);
  EXPECT_LT(largest_difference(found, foot + RowVector3d(0, 0.3, 0.1)), 1e-14);

  const Mesh sheet = test::sheet(2);
  const Positions collapsed = Positions::Zero(9, 3);
  EXPECT_LT(largest_difference(carried(RowVector3d(0.3, 0.4, 0.2), sheet, collapsed), RowVector3d(0, 0, 0.2)), 1e-15);
}

#ifdef _OPENMP
TEST_F(Carry, IsTheSameBytesForAnyNumberOfThreads) {
  const Mesh mesh = test::bumpy_sphere(3);
  const Positions points = test::points_near(mesh, 3000, 1), moved = mesh.positions.array().sin();
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const Positions one = carried(points, mesh, moved);
  omp_set_num_threads(2);
  EXPECT_EQ(carried(points, mesh, moved), one);
  omp_set_num_threads(threads);
}
#endif

TEST(CarryInput, TakesColumnMajorMatrices) {
  const Mesh mesh = test::torus();
  const Attachments attachments{Eigen::VectorXi::Constant(1, 5), RowVector3d(0.2, 0.3, 0.5), RowVector3d(1, 2, 3)};
  const Positions moved = mesh.positions.array().sin();
  const Eigen::MatrixXd rest_columns = mesh.positions, moved_columns = moved;
  const Eigen::MatrixXi triangles = mesh.triangles;
  EXPECT_EQ(carry(attachments, triangles, rest_columns, moved_columns),
            carry(attachments, mesh.triangles, mesh.positions, moved));
}

TEST(CarryInput, RefusesWhatDoesNotFit) {
  const Mesh mesh = test::sheet(2);
  const Attachments good{Eigen::VectorXi::Zero(3), Positions::Constant(3, 3, 1. / 3), Positions::Zero(3, 3)};
  const auto refusal = [&](const Attachments& attachments, const Positions& moved,
                           const Transforms* transforms = nullptr) -> std::string {
    try {
      carry(attachments, mesh.triangles, mesh.positions, moved, transforms);
    } catch (const InvalidInput& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(refusal(good, mesh.positions), "");
  EXPECT_THAT(refusal(good, mesh.positions.topRows(7)), HasSubstr("vertex"));
  EXPECT_THAT(refusal(good, Positions::Zero(12, 3)), HasSubstr("moved: 12 rows"));
  Attachments bad = good;
  bad.triangles[1] = 8;
  EXPECT_THAT(refusal(bad, mesh.positions), HasSubstr("row 1 names triangle 8"));
  bad = good;
  bad.barycentric(2, 0) = std::nan("");
  EXPECT_THAT(refusal(bad, mesh.positions), HasSubstr("row 2"));
  bad = good;
  bad.offsets.resize(2, 3);
  EXPECT_THAT(refusal(bad, mesh.positions), HasSubstr("attachments"));
  Transforms transforms = everywhere(Matrix3d::Identity(), 7);
  EXPECT_THAT(refusal(good, mesh.positions, &transforms), HasSubstr("transforms: 7 rows"));
  transforms = everywhere(Matrix3d::Identity(), 8);
  transforms(5, 4) = std::nan("");
  EXPECT_THAT(refusal(good, mesh.positions, &transforms), HasSubstr("transforms: row 5"));
}

/// Bends what lies in a mesh's box, more and more along x.
class Bend {
 public:
  explicit Bend(const Mesh& mesh) : low_(mesh.positions.col(0).minCoeff()), size_(box_diagonal(mesh.positions)) {}

  Positions operator()(Positions positions) const {
    for (auto p : positions.rowwise()) {
      const double along = (p[0] - low_) / size_;
      p += size_ * RowVector3d(0, 0.3 * along * along, 0.1 * std::sin(3 * along));
    }
    return positions;
  }

  /// Its derivatives in the triangles' middles.
  Transforms in(const Mesh& mesh) const {
    Transforms transforms(mesh.triangles.rows(), 9);
    for (Eigen::Index t = 0; t < transforms.rows(); ++t) {
      double middle = 0;
      for (int k = 0; k < 3; ++k) middle += mesh.positions(mesh.triangles(t, k), 0) / 3;
      const double along = (middle - low_) / size_;
      transforms.row(t) << 1, 0, 0, 0.6 * along, 1, 0, 0.3 * std::cos(3 * along), 0, 1;
    }
    return transforms;
  }

 private:
  double low_, size_;
};

TEST_F(Carry, ABendOfACoarseOrFineStandInBendsARealMesh) {
  if (!test::has_shared()) GTEST_SKIP() << "no real meshes beside this checkout";
  for (const char* name : {"A_closed_manifold/cgal_fandisk.off", "A_closed_manifold/rotor_remeshed.off",
                           "A_closed_manifold/m0839_sofa.obj", "B_open_manifold/holes.off"}) {
    SCOPED_TRACE(name);
    const Mesh mesh = read_mesh(test::shared("data/meshes") / name).mesh;
    const Mesh coarse = decimate(mesh, static_cast<int>(mesh.triangles.rows()) / 5, {}).mesh;
    const Bend bend(mesh);
    const Positions due = bend(mesh.positions);
    for (const Mesh& stand_in : {coarse, test::subdivided(mesh)}) {
      const Positions moved = bend(stand_in.positions);
      const Transforms transforms = bend.in(stand_in);
      const double size = box_diagonal(mesh.positions);
      EXPECT_LT(largest_difference(carried(mesh.positions, stand_in, stand_in.positions), mesh.positions),
                1e-12 * size);
      EXPECT_LT(largest_difference(carried(mesh.positions, stand_in, moved, &transforms), due), 1e-2 * size);
      EXPECT_LT(largest_difference(carried(mesh.positions, stand_in, moved), due), 2e-2 * size);
    }
  }
}

}  // namespace
}  // namespace swage
