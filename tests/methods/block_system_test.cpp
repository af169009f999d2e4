#include "block_system.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "swage/error.h"

namespace swage {
namespace {

struct Dense {
  BlockSystem system;
  Eigen::MatrixXd matrix;
};

/// The same random positive definite system, as blocks and dense.
Dense random_system(int groups, int rows, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<std::pair<int, int>> couplings;
  for (int i = 0; i < groups; ++i) {
    for (int step : {1, 5}) {
      if (i + step < groups) couplings.emplace_back(i + step, i);
    }
  }
  const int width = 3 * rows;
  Dense both{BlockSystem(groups, rows, couplings), Eigen::MatrixXd::Zero(groups * width, groups * width)};
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

class BlockSystemOfRows : public testing::TestWithParam<int> {};

TEST_P(BlockSystemOfRows, EqualsTheDenseSystem) {
  Dense both = random_system(17, GetParam(), 1);
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(both.matrix.rows(), -1, 2);
  EXPECT_LT((both.system.times(x) - both.matrix * x).norm(), 1e-12 * (both.matrix * x).norm());
  both.system.factor();
  EXPECT_LT((both.system.solve(both.matrix * x) - x).norm(), 1e-12 * x.norm());
}

INSTANTIATE_TEST_SUITE_P(Widths, BlockSystemOfRows, testing::Values(1, 3));

TEST(BlockSystem, AFactorBeyondIntIsRefused) {
  constexpr int kSide = 800;
  std::vector<std::pair<int, int>> couplings;
  for (int i = 0; i < kSide * kSide; ++i) {
    if (i % kSide != 0) couplings.emplace_back(i, i - 1);
    if (i >= kSide) couplings.emplace_back(i, i - kSide);
    if (i >= kSide && i % kSide != 0) couplings.emplace_back(i, i - kSide - 1);
  }
  EXPECT_THROW(BlockSystem(kSide * kSide, 3, couplings), Unsolvable);
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

TEST(BlockSystem, NamesTheGroupOfAZeroOrNegativePivot) {
  for (const double pivot : {0.0, -1.0, std::nan("")}) {
    BlockSystem system(3, 1, {});
    system.add(0, Eigen::Matrix3d::Identity());
    system.add(1, pivot * Eigen::Matrix3d::Identity());
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
