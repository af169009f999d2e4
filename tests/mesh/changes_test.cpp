#include "changes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "measures.h"
#include "shapes.h"

namespace swage::test {
namespace {

/// About the x axis.
Positions rotated(const Positions& positions, double angle) {
  return positions * Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()).toRotationMatrix().transpose();
}

/// Two triangles apart: one of area 8 in the plane z = 0, one of area 0.5 in z = 5.
Mesh large_and_small() {
  Mesh mesh;
  mesh.positions.resize(6, 3);
  mesh.positions << 0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 5, 1, 0, 5, 0, 1, 5;
  mesh.triangles.resize(2, 3);
  mesh.triangles << 0, 1, 2, 3, 4, 5;
  return mesh;
}

struct NormalTurns : Spread {
  int flipped;
};

NormalTurns turns_of(const Positions& before, const Positions& after, const Triangles& triangles) {
  const Eigen::VectorXd turns = normal_turns(before, after, triangles);
  return {spread(turns, area_vectors(before, triangles).rowwise().norm()), flipped(turns)};
}

TEST(NormalTurns, OfARotationAreItsAngleAwayFromTheAxis) {
  const Mesh mesh = large_and_small();
  const NormalTurns turns = turns_of(mesh.positions, rotated(mesh.positions, 30 * kDegree), mesh.triangles);
  EXPECT_NEAR(turns.mean, 30 * kDegree, 1e-12);
  EXPECT_NEAR(turns.percentile_95, 30 * kDegree, 1e-12);
  EXPECT_NEAR(turns.max, 30 * kDegree, 1e-12);
  EXPECT_EQ(turns.flipped, 0);
}

TEST(NormalTurns, AreWeighedByArea) {
  const Mesh mesh = large_and_small();
  Positions after = mesh.positions;
  after.bottomRows(3) = rotated(after.bottomRows(3), 120 * kDegree);
  const NormalTurns turns = turns_of(mesh.positions, after, mesh.triangles);
  EXPECT_NEAR(turns.mean, 120 * kDegree * 0.5 / 8.5, 1e-12);
  EXPECT_NEAR(turns.percentile_95, 120 * kDegree, 1e-12);  // The large one is 94.1 % of the area.
  EXPECT_NEAR(turns.max, 120 * kDegree, 1e-12);
  EXPECT_EQ(turns.flipped, 1);

  after = mesh.positions;
  after.row(5) = after.row(4);
  EXPECT_EQ(turns_of(mesh.positions, after, mesh.triangles).max, 0) << "a triangle without area has no normal";
  after.row(2) << 0, 40, 0;
  after.bottomRows(3) = rotated(mesh.positions.bottomRows(3), 120 * kDegree);
  EXPECT_NEAR(turns_of(mesh.positions, after, mesh.triangles).mean, 120 * kDegree * 0.5 / 8.5, 1e-12)
      << "the area before counts";
}

TEST(CrossingChange, CountsThoseThatWereNotThere) {
  const Mesh mesh = large_and_small();
  // The small one stands through the large one.
  Positions through = mesh.positions;
  through.row(3) << 1, 1, -1;
  through.row(4) << 1, 1, 1;
  through.row(5) << 1.5, 1, 1;
  const auto change = [&](const Positions& before, const Positions& after) {
    return crossing_change(before, after, mesh.triangles, 10).value();
  };
  EXPECT_EQ(change(mesh.positions, through).before, 0);
  EXPECT_EQ(change(mesh.positions, through).fresh, 1);
  EXPECT_EQ(change(through, through).before, 1);
  EXPECT_EQ(change(through, through).fresh, 0);
  EXPECT_EQ(change(through, mesh.positions).fresh, 0);
  EXPECT_FALSE(crossing_change(mesh.positions, through, mesh.triangles, 0));
}

}  // namespace
}  // namespace swage::test
