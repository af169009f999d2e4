#include "anderson.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <random>

namespace swage {
namespace {

constexpr int kVertices = 4;

/// x -> A x + b, which contracts slowly, with its fixed point.
struct Linear {
  Eigen::MatrixXd A;
  Eigen::VectorXd b, fixed;

  explicit Linear(double largest) {
    std::mt19937 random(11);
    std::normal_distribution<double> normal;
    const Eigen::Index n = 3 * kVertices;
    const Eigen::MatrixXd any = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return normal(random); });
    const Eigen::MatrixXd basis = any.householderQr().householderQ();
    const Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(n, 0.1, largest);
    A = basis * values.asDiagonal() * basis.transpose();
    b = Eigen::VectorXd::NullaryExpr(n, [&] { return normal(random); });
    fixed = (Eigen::MatrixXd::Identity(n, n) - A).partialPivLu().solve(b);
  }

  Positions operator()(const Positions& x) const {
    const Eigen::VectorXd y = A * Eigen::Map<const Eigen::VectorXd>(x.data(), x.size()) + b;
    return Eigen::Map<const Positions>(y.data(), kVertices, 3);
  }

  double distance(const Positions& x) const {
    return (Eigen::Map<const Eigen::VectorXd>(x.data(), x.size()) - fixed).norm();
  }
};

Positions after(const Linear& map, int window, int passes) {
  Anderson acceleration(window);
  Positions start = Positions::Zero(kVertices, 3);
  for (int i = 0; i < passes; ++i) start = acceleration.next(start, map(start));
  return start;
}

// On a linear map with as many passes kept as there are unknowns it is GMRES: exact after one pass more.
TEST(Anderson, SolvesALinearMapInAsManyPassesAsUnknowns) {
  const Linear map(0.99);
  EXPECT_LT(map.distance(after(map, 20, 3 * kVertices + 2)), 1e-6 * map.fixed.norm());
}

TEST(Anderson, GetsCloserThanPlainPasses) {
  const Linear map(0.99);
  const double plain = map.distance(after(map, 0, 30)), accelerated = map.distance(after(map, 5, 30));
  EXPECT_LT(accelerated, plain / 100);
}

TEST(Anderson, WithoutAWindowItIsThePlainPass) {
  const Linear map(0.9);
  Positions plain = Positions::Zero(kVertices, 3);
  for (int i = 0; i < 7; ++i) plain = map(plain);
  EXPECT_EQ(after(map, 0, 7), plain);
}

TEST(Anderson, StaysAtAFixedPoint) {
  Anderson acceleration(5);
  const Positions still = Positions::Ones(kVertices, 3);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(acceleration.next(still, still), still);
}

// A pass from a combined start that goes far: back to where the pass before ended.
TEST(Anderson, GoesBackWhereItWasLedAstray) {
  Anderson acceleration(5);
  const auto at = [](double x) { return Positions(Positions::Constant(kVertices, 3, x)); };
  acceleration.next(at(0), at(1));
  const Positions combined = acceleration.next(at(1), at(1.5));
  EXPECT_NEAR(combined(0, 0), 2, 1e-9);  // 0, 1, 1.5, …
  EXPECT_EQ(acceleration.next(combined, combined + at(5)), at(1.5));
}

// Plain passes may grow, and nothing is better known: no going back and forth for ever.
TEST(Anderson, PlainPassesThatGrowAreNotTakenBack) {
  Anderson acceleration(5);
  const auto at = [](double x) { return Positions(Positions::Constant(kVertices, 3, x)); };
  acceleration.next(at(0), at(1));
  const Positions combined = acceleration.next(at(1), at(1.5));
  ASSERT_EQ(acceleration.next(combined, combined + at(5)), at(1.5));
  EXPECT_EQ(acceleration.next(at(1.5), at(9)), at(9));
}

}  // namespace
}  // namespace swage
