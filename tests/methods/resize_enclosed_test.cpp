// What vulnerable cells enclose is as vulnerable as they are.
#include <gtest/gtest.h>

#include "ball_amid_slabs.h"
#include "cell_maps.h"
#include "enclosed.h"
#include "resize_models.h"

namespace swage::test {
namespace {

/// A ring about z in one slice, without corners, so that its cells meet at edges only.
CellMap ring_map(const GridShape& shape) {
  CellMap map = free_map(shape);
  for (const auto& [i, j] : {std::pair{3, 2}, {4, 2}, {5, 3}, {5, 4}, {4, 5}, {3, 5}, {2, 4}, {2, 3}}) {
    map.theta.row(shape.cells.at(i, j, 1)) << 0.2, 1, 0;
  }
  return map;
}

TEST(Enclosed, IsVulnerableAlongTheAxesOfItsSlice) {
  const GridShape shape = unit_cells(8, 8, 3);
  CellMap map = ring_map(shape), due = map;
  for (const auto& [i, j] : {std::pair{3, 3}, {4, 3}, {3, 4}, {4, 4}}) {
    due.theta.row(shape.cells.at(i, j, 1)) << 1, 1, 0;
  }
  protect_enclosed(shape, map);
  EXPECT_EQ(map.theta, due.theta);
  EXPECT_EQ(map.phi, due.phi);
}

TEST(Enclosed, IsNothingWhereTheRingIsOpenOrHardlyVulnerableAlongAnAxis) {
  const GridShape shape = unit_cells(8, 8, 3);
  CellMap open = ring_map(shape);
  open.theta.row(shape.cells.at(5, 4, 1)) << 0.05, 1, 1;
  CellMap map = open;
  protect_enclosed(shape, map);
  EXPECT_EQ(map.theta, open.theta);
}

TEST(Enclosed, NeedsASliceOfThreeCells) {
  for (const GridShape& shape : {unit_cells(2, 9, 2), unit_cells(1, 1, 9), unit_cells(1, 1, 1)}) {
    CellMap map = protected_map(shape);
    map.theta.row(0).setZero();
    const CellMap due = map;
    protect_enclosed(shape, map);
    EXPECT_EQ(map.theta, due.theta);
  }
}

TEST(Enclosed, IsTheInsideOfABoltHoleUntilItIsReleased) {
  const Assembled model = bolted_plate();
  Resize plan(model.mesh.positions, model.mesh.triangles);
  const GridShape& shape = plan.shape();
  const auto inside = [&](double x, double z) {
    return shape.cells.at(static_cast<int>(x - shape.corner[0]), 2, static_cast<int>(z - shape.corner[2]));
  };
  for (const double x : {-20.5, 20.5}) {
    EXPECT_EQ(plan.map().theta.row(inside(x, -9.5)), Eigen::RowVector3d(1, 0, 1));
    EXPECT_EQ(plan.map().phi[inside(x, -9.5)], 0.5);  // No face touches it.
  }
  const CellMap found = plan.map();
  Protection release;
  release.box = Eigen::AlignedBox3d(Eigen::Vector3d(-24, -2, -14), Eigen::Vector3d(-21, 2, -6));  // A side of one.
  release.value = 0;
  plan.protect(release);
  EXPECT_EQ(plan.map().theta.row(inside(-19.5, -9.5)), Eigen::RowVector3d(0, 0, 0));
  EXPECT_EQ(plan.map().theta.row(inside(20.5, -9.5)), Eigen::RowVector3d(1, 0, 1));
  plan.reset_map();
  EXPECT_EQ(plan.map().theta, found.theta);
  // Said of what is enclosed, it counts as well; and a whole map is taken as it is.
  release.box = Eigen::AlignedBox3d(Eigen::Vector3d(-21, -2, -11), Eigen::Vector3d(-20, 2, -10));
  plan.protect(release);
  EXPECT_EQ(plan.map().theta.row(inside(-20.5, -10.5)), Eigen::RowVector3d(0, 0, 0));
  EXPECT_EQ(plan.map().theta.row(inside(-19.5, -9.5)), Eigen::RowVector3d(1, 0, 1));
  CellMap map = found;
  map.theta.row(inside(20.5, -9.5)).setZero();
  plan.set_map(map);
  EXPECT_EQ(plan.map().theta, map.theta);
}

}  // namespace
}  // namespace swage::test
