#include "block_system.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <optional>
#include <random>
#include <thread>

#include "swage/error.h"

namespace swage {
namespace {

struct Dense {
  BlockSystem system;
  Eigen::MatrixXd matrix;
};

/// The same random positive definite system, as blocks and dense.
Dense random_system(int groups, int rows, unsigned seed, std::optional<FactorKind> kind = {}) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<std::pair<int, int>> couplings;
  for (int i = 0; i < groups; ++i) {
    for (int step : {1, 5}) {
      if (i + step < groups) couplings.emplace_back(i + step, i);
    }
  }
  const int width = 3 * rows;
  Dense both{BlockSystem(groups, rows, couplings, kind), Eigen::MatrixXd::Zero(groups * width, groups * width)};
  for (const auto& [i, j] : couplings) {
    for (int r = 0; r < rows; ++r) {
      const Eigen::Matrix3d block = Eigen::Matrix3d::NullaryExpr([&] { return number(random); });
      both.system.add(i, j, r, block);
      both.matrix.block<3, 3>(i * width + 3 * r, j * width + 3 * r) += block;
      both.matrix.block<3, 3>(j * width + 3 * r, i * width + 3 * r) += block.transpose();
    }
  }
  for (int i = 0; i < groups; ++i) {
    const Eigen::MatrixXd half = Eigen::MatrixXd::NullaryExpr(width, width, [&] { return number(random); });
    const Eigen::MatrixXd block = half * half.transpose() + 20 * Eigen::MatrixXd::Identity(width, width);
    both.system.add(i, block);
    both.matrix.block(i * width, i * width, width, width) += block;
  }
  return both;
}

std::vector<FactorKind> kinds() {
  if (!has_cholmod()) return {FactorKind::simplicial};
  return {FactorKind::simplicial, FactorKind::supernodal};
}

class BlockSystemBy : public testing::TestWithParam<FactorKind> {};

INSTANTIATE_TEST_SUITE_P(Kinds, BlockSystemBy, testing::ValuesIn(kinds()), [](const auto& kind) {
  return kind.param == FactorKind::supernodal ? "supernodal" : "simplicial";
});

void expect_equal(Dense& both) {
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(both.matrix.rows(), -1, 2);
  EXPECT_LT((both.system.times(x) - both.matrix * x).norm(), 1e-12 * (both.matrix * x).norm());
  both.system.factor();
  EXPECT_LT((both.system.solve(both.matrix * x) - x).norm(), 1e-12 * x.norm());
}

TEST_P(BlockSystemBy, EqualsTheDenseSystem) {
  for (const int rows : {1, 3}) {
    for (const int groups : {1, 2, 17, 300}) {
      SCOPED_TRACE(testing::Message() << groups << " groups of " << rows << " rows");
      Dense both = random_system(groups, rows, 1, GetParam());
      expect_equal(both);
    }
  }
}

TEST_P(BlockSystemBy, FactorsOtherValuesByTheSameAnalysis) {
  Dense both = random_system(40, 3, 3, GetParam());
  expect_equal(both);
  const Eigen::VectorXd x = Eigen::VectorXd::Ones(both.matrix.rows());
  const Eigen::VectorXd first = both.system.solve(x);
  const Eigen::VectorXd values = both.system.values();
  for (int g = 0; g < 40; ++g) both.system.add(g, 5 * Eigen::MatrixXd::Identity(9, 9));
  both.matrix.diagonal().array() += 5;
  expect_equal(both);
  both.system.values() = values;
  both.system.factor();
  EXPECT_EQ(both.system.solve(x), first);
}

TEST_P(BlockSystemBy, SolvesManyColumnsAtOnce) {
  Dense both = random_system(40, 1, 4, GetParam());
  both.system.factor();
  for (const int columns : {5, 1, 3}) {
    const Eigen::MatrixXd x = Eigen::MatrixXd::Random(both.matrix.rows(), columns);
    EXPECT_LT((both.system.solve(both.matrix * x) - x).norm(), 1e-12 * x.norm());
  }
}

TEST_P(BlockSystemBy, DisconnectedGroups) {
  BlockSystem system(5, 1, {{0, 3}}, GetParam());
  for (int g = 0; g < 5; ++g) system.add(g, (g + 1) * Eigen::Matrix3d::Identity());
  system.add(0, 3, 0, Eigen::Matrix3d::Identity());
  system.factor();
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(15, 1, 2);
  EXPECT_LT((system.solve(system.times(x)) - x).norm(), 1e-14);
}

TEST_P(BlockSystemBy, NoGroups) {
  BlockSystem system(0, 3, {}, GetParam());
  system.factor();
  EXPECT_EQ(system.solve(Eigen::VectorXd()).size(), 0);
  EXPECT_EQ(system.factor_entries(), 0);
}

TEST_P(BlockSystemBy, GoesOnAfterAFailure) {
  Dense both = random_system(17, 1, 5, GetParam());
  const Eigen::VectorXd values = both.system.values();
  both.system.set_zero();
  EXPECT_THROW(both.system.factor(), Unsolvable);
  both.system.values() = values;
  expect_equal(both);
}

TEST_P(BlockSystemBy, TheSameBytesFromTwoThreadsAtOnce) {
  const auto solution = [] {
    Dense both = random_system(400, 3, 6, GetParam());
    both.system.factor();
    return Eigen::VectorXd(both.system.solve(Eigen::VectorXd::Ones(both.matrix.rows())));
  };
  const Eigen::VectorXd alone = solution();
  Eigen::VectorXd other;
  std::thread thread([&] { other = solution(); });
  EXPECT_EQ(solution(), alone);
  thread.join();
  EXPECT_EQ(other, alone);
}

TEST_P(BlockSystemBy, OneFactorSolvesForTwoThreadsAtOnce) {
  Dense both = random_system(400, 3, 6, GetParam());
  both.system.factor();
  const BlockSystem& system = both.system;
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(both.matrix.rows()), other_side = 2 * ones;
  const Eigen::VectorXd expected = system.solve(ones), other_expected = system.solve(other_side);
  std::thread thread([&] {
    for (int i = 0; i < 20; ++i) EXPECT_EQ(system.solve(other_side), other_expected);
  });
  for (int i = 0; i < 20; ++i) EXPECT_EQ(system.solve(ones), expected);
  thread.join();
}

TEST_P(BlockSystemBy, ACopyToBeFactoredHasTheSameValuesAndItsOwnFactor) {
  Dense both = random_system(40, 3, 7, GetParam());
  both.system.factor();
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(both.matrix.rows(), -1, 2), side = both.system.times(x);
  const Eigen::VectorXd expected = both.system.solve(side);
  Dense copy{both.system.unfactored(), both.matrix};
  EXPECT_EQ(copy.system.times(x), side);
  copy.system.factor();
  EXPECT_EQ(copy.system.solve(side), expected);
  copy.system.values() *= 2;
  copy.matrix *= 2;
  expect_equal(copy);
  EXPECT_EQ(both.system.solve(side), expected);
}

TEST_P(BlockSystemBy, SolvesNearAGuess) {
  Dense both = random_system(300, 1, 8, GetParam());
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(both.matrix.rows(), -1, 2);
  const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(x.size());
  EXPECT_LT((both.system.solve_near(both.matrix * x, nothing) - x).norm(), 1e-12 * x.norm()) << "the first is exact";
  // Another matrix near the factored one, and one far from it.
  for (const double more : {3.0, 1000.0}) {
    for (int g = 0; g < 300; g += 2) both.system.add(g, more * Eigen::Matrix3d::Identity());
    for (int i = 0; i < both.matrix.rows(); ++i) both.matrix(i, i) += i / 3 % 2 == 0 ? more : 0;
    const Eigen::VectorXd guess = x + 0.01 * Eigen::VectorXd::Ones(x.size());
    EXPECT_LT((both.system.solve_near(both.matrix * x, guess) - x).norm(), 1e-4 * (guess - x).norm()) << more;
  }
  both.system.forget_factor();
  EXPECT_LT((both.system.solve_near(both.matrix * x, nothing) - x).norm(), 1e-12 * x.norm()) << "exact again";
}

std::vector<std::pair<int, int>> grid(int side) {
  std::vector<std::pair<int, int>> couplings;
  for (int i = 0; i < side * side; ++i) {
    if (i % side != 0) couplings.emplace_back(i, i - 1);
    if (i >= side) couplings.emplace_back(i, i - side);
    if (i >= side && i % side != 0) couplings.emplace_back(i, i - side - 1);
  }
  return couplings;
}

// As many groups as several threads share, in two orders.
TEST(BlockSystem, TimesIsTheSameInAnyOrder) {
  const int side = 160;
  BlockSystem given(side * side, 1, grid(side), FactorKind::none);
  BlockSystem ordered(side * side, 1, grid(side), FactorKind::simplicial);
  Eigen::Matrix3d block;
  block << 1, 2, 3, -4, 5, 6, 7, -8, 9;
  for (const auto& [i, j] : grid(side)) {
    block *= -1.01;
    if (block.norm() > 1e3) block /= block.norm();
    for (BlockSystem* system : {&given, &ordered}) {
      system->add(i, j, 0, block);
      system->add(i, block + block.transpose());
    }
  }
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(given.unknowns(), -1, 2), product = given.times(x);
  EXPECT_GT(product.norm(), 1);
  EXPECT_LT((ordered.times(x) - product).norm(), 1e-12 * product.norm());
}

TEST(BlockSystem, AFactorBeyondIntIsRefused) { EXPECT_THROW(BlockSystem(800 * 800, 3, grid(800)), Unsolvable); }

/// However large the system, and so whatever factor and order are taken.
TEST(BlockSystem, SolvesWhateverTheSize) {
  for (const int side : {3, 30, 201}) {
    const auto couplings = grid(side);
    BlockSystem system(side * side, 1, couplings);
    for (int g = 0; g < side * side; ++g) system.add(g, 7 * Eigen::Matrix3d::Identity());
    for (const auto& [i, j] : couplings) system.add(i, j, 0, -Eigen::Matrix3d::Identity());
    system.factor();
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(system.unknowns(), -1, 1);
    EXPECT_LT((system.solve(system.times(x)) - x).norm(), 1e-11 * x.norm());
  }
}

/// A factor in single precision alone, of dense blocks or of none.
TEST_P(BlockSystemBy, ImprovesAGuessInSinglePrecision) {
  const auto couplings = grid(60);
  BlockSystem system(60 * 60, 3, couplings, GetParam());
  const Eigen::MatrixXd own = 8 * Eigen::MatrixXd::Identity(9, 9) + Eigen::MatrixXd::Ones(9, 9);
  for (int g = 0; g < 60 * 60; ++g) system.add(g, own);
  for (const auto& [i, j] : couplings) {
    for (int r = 0; r < 3; ++r) system.add(i, j, r, -Eigen::Matrix3d::Identity());
  }
  system.factor();
  const auto entries = system.factor_entries();
  const std::size_t bytes = system.bytes();
  ASSERT_EQ(system.keep_single(), GetParam() == FactorKind::supernodal);
  if (!system.single()) return;
  EXPECT_EQ(system.factor_entries(), entries);
  EXPECT_LT(system.bytes(), bytes);
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(system.unknowns(), -1, 2), side = system.times(x);
  Eigen::VectorXd guess = Eigen::VectorXd::Zero(x.size());
  for (const double left : {1e-4, 1e-8, 1e-12}) {
    const Eigen::VectorXd better = system.improved(side, guess);
    EXPECT_LT((better - x).norm(), left * x.norm());
    EXPECT_EQ(system.improved(side, guess), better) << "the same bytes";
    guess = better;
  }
}

TEST_P(BlockSystemBy, KeepsTheFactorWhereSinglePrecisionDoesNotDo) {
  BlockSystem system(2, 1, {{0, 1}}, GetParam());
  const double near = 1 + 1e-12;
  for (int g = 0; g < 2; ++g) system.add(g, near * Eigen::Matrix3d::Identity());
  system.add(0, 1, 0, -Eigen::Matrix3d::Identity());
  system.factor();
  EXPECT_FALSE(system.keep_single());
  EXPECT_LT(system.solve(Eigen::VectorXd::Zero(6)).norm(), 1e-12);
}

TEST(BlockSystem, WithoutCholmodSaysSo) {
  if (has_cholmod()) {
    EXPECT_NO_THROW(BlockSystem(2, 1, {{0, 1}}, FactorKind::supernodal));
  } else {
    EXPECT_THROW(BlockSystem(2, 1, {{0, 1}}, FactorKind::supernodal), Unavailable);
  }
}

TEST(BlockSystem, RestoresAConstantPart) {
  Dense both = random_system(9, 1, 2);
  const Eigen::VectorXd constant = both.system.values();
  const Eigen::VectorXd x = Eigen::VectorXd::Ones(both.matrix.rows());
  const Eigen::VectorXd before = both.system.times(x);
  both.system.add(4, 7 * Eigen::Matrix3d::Identity());
  EXPECT_GT((both.system.times(x) - before).norm(), 1);
  both.system.values() = constant;
  EXPECT_EQ(both.system.times(x), before);
}

TEST_P(BlockSystemBy, NamesTheGroupOfAZeroOrNegativePivot) {
  for (const double pivot : {0.0, -1.0, std::nan("")}) {
    BlockSystem system(3, 1, {}, GetParam());
    system.add(0, Eigen::Matrix3d::Identity());
    system.add(1, Eigen::Vector3d(1, pivot, 1).asDiagonal().toDenseMatrix());
    system.add(2, Eigen::Matrix3d::Identity());
    try {
      system.factor();
      ADD_FAILURE() << "factored with pivot " << pivot;
    } catch (const Unsolvable& error) {
      EXPECT_NE(std::string(error.what()).find("element 1"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace swage
