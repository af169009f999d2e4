// Cells of the protective grid: what they carry, and whether they fold.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "carry.h"
#include "cell_maps.h"
#include "folds.h"

namespace swage::test {
namespace {

TEST(GridCarry, FollowsTheVerticesAndLinearMaps) {
  const GridShape shape = {{{4, 3, 5}}, {-1, 2, 3}, {6, 5, 4}};
  const AxisValues rest = rest_vertices(shape);
  const AxisValues waves = rest + 0.1 * (3 * rest).array().sin().matrix();
  EXPECT_LT((carry(shape, waves, rest) - waves).cwiseAbs().maxCoeff(), 1e-12);
  Eigen::Matrix3d linear;
  linear << 2, 0.1, 0, -0.3, 1, 0.2, 0, 0.4, 0.5;
  const Positions points = Positions::Random(40, 3) * 9;  // Within and outside.
  EXPECT_LT((carry(shape, rest * linear, points) - points * linear).cwiseAbs().maxCoeff(), 1e-12);
  const GridShape flat = {{{4, 1, 5}}, {-1, 2, 3}, {6, 0, 4}};
  EXPECT_LT((carry(flat, rest_vertices(flat), points) - points).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(GridFolds, AreFoundWhereAnyPointTurnsOver) {
  const GridShape shape = {{{1, 1, 1}}, {0, 0, 0}, {2, 3, 4}};
  int folded = 0, sound = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    std::srand(seed);
    const AxisValues vertices = rest_vertices(shape) + 1.2 * AxisValues::Random(8, 3);
    double least = 1e300;
    for (int n = 0; n < 7 * 7 * 7; ++n) {
      const Eigen::RowVector3d at(n % 7 / 6.0, n / 7 % 7 / 6.0, n / 49 / 6.0);
      least = std::min(least, determinant(shape, vertices, at, {0, 0, 0}, {1, 1, 1}));
    }
    const bool found = !folded_cells(shape, vertices, 0).empty();
    if (least < 0) {
      EXPECT_TRUE(found) << seed;
    } else if (least > 0.05) {
      EXPECT_FALSE(found) << seed;
    }
    ++(found ? folded : sound);
  }
  EXPECT_GT(folded, 30);
  EXPECT_GT(sound, 30);
}

}  // namespace
}  // namespace swage::test
