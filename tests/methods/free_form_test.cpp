// Free-form deformation (host/template/free_form.cpp): what it does where it is told, and where it is not.
#include "free_form.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <random>

namespace swage::test {
namespace {

using Eigen::Index;
using Eigen::RowVector3d;
using Eigen::VectorXd;

/// Points of a box of 1 by 0.5 by 0.25.
Positions scattered(int count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(0, 1);
  Positions points(count, 3);
  for (auto point : points.rowwise()) point << part(random), 0.5 * part(random), 0.25 * part(random);
  points.topRows(2) << 0, 0, 0, 1, 0.5, 0.25;
  return points;
}

/// Along x at the first third of the points, along y at the next, along z at the last.
Positions line_values(Index count) {
  Positions directions = Positions::Zero(count, 3);
  for (Index v = 0; v < count; ++v) directions(v, 3 * v / count) = 1;
  return directions;
}

/// Control points of what is told with equal weights.
Positions fitted(const FreeForm& form, const Positions& directions, const VectorXd& amounts,
                 const std::vector<Positions>& idle = {}) {
  return form.fit(directions, amounts, VectorXd::Ones(amounts.size()), idle);
}

TEST(FreeForm, HasTheMapsOfItsDisplacements) {
  constexpr int kCount = 200;
  constexpr double kStep = 1e-7;
  Positions points(4 * kCount, 3);
  points.topRows(kCount) = 0.5 * scattered(kCount);
  for (int k = 0; k < 3; ++k) {
    points.middleRows((k + 1) * kCount, kCount) = points.topRows(kCount).rowwise() + kStep * RowVector3d::Unit(k);
  }
  const FreeForm form(points);
  std::mt19937 random(5);
  std::normal_distribution<double> part;
  VectorXd amounts(points.rows());
  for (double& amount : amounts) amount = part(random);
  const Positions control = fitted(form, line_values(points.rows()), amounts);
  const Positions moved = form.displacements(control);
  const Transforms maps = form.maps(control);
  for (int v = 0; v < kCount; ++v) {
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> map(maps.row(v).data());
    for (int k = 0; k < 3; ++k) {
      const RowVector3d slope = (moved.row((k + 1) * kCount + v) - moved.row(v)) / kStep;
      EXPECT_LT((RowVector3d::Unit(k) + slope - map.col(k).transpose()).norm(), 1e-3 * (1 + slope.norm())) << v;
    }
  }
}

/// Of a bar whose ends alone are told of, the middle stretches evenly.
TEST(FreeForm, StretchesEvenlyWhatIsNotTold) {
  const Positions points = scattered(3000);
  VectorXd weights(points.rows());
  for (Index v = 0; v < points.rows(); ++v) weights[v] = points(v, 0) < 0.1 || points(v, 0) > 0.9 ? 1 : 0;
  const FreeForm form(points);
  const auto along_x = RowVector3d::UnitX().replicate(points.rows(), 1);
  const Positions moved = form.displacements(form.fit(along_x, 0.1 * points.col(0), weights, {}));
  EXPECT_LT((moved.col(0) - 0.1 * points.col(0)).cwiseAbs().maxCoeff(), 0.003);
  EXPECT_LT(moved.rightCols(2).cwiseAbs().maxCoeff(), 1e-6);
}

/// As a couch made longer: its arms are as wide as before, and that ends at once.
TEST(FreeForm, LeavesWidthsAtOnce) {
  const Positions points = scattered(6000);
  const Positions directions = line_values(points.rows());
  const auto shift = [](double x) { return x < 0.12 ? 0 : x > 0.88 ? 0.076 : 0.1 * (x - 0.12); };
  VectorXd amounts(points.rows());
  for (Index v = 0; v < points.rows(); ++v) amounts[v] = directions(v, 0) * shift(points(v, 0));
  const FreeForm form(points);
  const Positions moved = form.displacements(fitted(form, directions, amounts));
  double most = 0;
  for (Index v = 0; v < points.rows(); ++v) most = std::max(most, std::abs(moved(v, 0) - shift(points(v, 0))));
  EXPECT_LT(most, 0.002);
}

TEST(FreeForm, DoesNotMoveIdly) {
  const Positions points = scattered(500);
  Positions idle = Positions::Zero(points.rows(), 3);
  idle.col(2).setOnes();
  const VectorXd amounts = VectorXd::Constant(points.rows(), 0.01);
  // All of it is asked to rise, and next to nothing is told of going aside.
  Positions directions(points.rows(), 3);
  directions.rowwise() = RowVector3d(0, 1, 1e-2);
  const FreeForm form(points);
  EXPECT_NEAR(form.displacements(fitted(form, directions, amounts)).col(2).mean(), 1e-4, 1e-6);
  const Positions moved = form.displacements(fitted(form, directions, amounts, {idle}));
  EXPECT_NEAR(moved.col(2).mean(), 0, 1e-6);
  EXPECT_NEAR(moved.col(1).mean(), 0.01, 1e-4);
}

TEST(FreeForm, IsTheSameOnAnyNumberOfThreads) {
  const Positions points = scattered(2000);
  const FreeForm form(points);
  const auto moved = [&] {
    return form.displacements(fitted(form, line_values(points.rows()), points.col(1), {points}));
  };
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const Positions one = moved();
  omp_set_num_threads(4);
  const Positions four = moved();
  omp_set_num_threads(threads);
  EXPECT_EQ(one, four);
}

/// Where not all vertices are looked at, which ones is not for their order to say.
TEST(FreeForm, LooksAtSomeOfMany) {
  const Positions points = scattered(30000);
  const auto amounts_at = [](const Positions& at) -> VectorXd { return 0.1 * at.col(0).array().square(); };
  const auto along_x = RowVector3d::UnitX().replicate(points.rows(), 1);
  const FreeForm form(points);
  const Positions moved = form.displacements(fitted(form, along_x, amounts_at(points)));
  EXPECT_LT((moved.col(0) - amounts_at(points)).cwiseAbs().maxCoeff(), 2e-3);
  const Positions reversed = points.colwise().reverse();
  const FreeForm other(reversed);
  const Positions also = other.displacements(fitted(other, along_x, amounts_at(reversed)));
  EXPECT_LT((also.colwise().reverse() - moved).cwiseAbs().maxCoeff(), 1e-10);
}

/// A sheet, whose box is flat, and a line.
TEST(FreeForm, TakesWhatIsFlat) {
  for (const int flat : {1, 2}) {
    Positions points = scattered(300);
    points.rightCols(flat).setZero();
    VectorXd amounts = 0.1 * points.col(0);
    const Positions directions = RowVector3d::UnitX().replicate(points.rows(), 1);
    const FreeForm form(points);
    const Positions control = fitted(form, directions, amounts);
    EXPECT_LT((form.displacements(control).col(0) - amounts).cwiseAbs().maxCoeff(), 1e-3);
    EXPECT_TRUE(form.maps(control).allFinite());
  }
}

}  // namespace
}  // namespace swage::test
