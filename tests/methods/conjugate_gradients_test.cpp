#include "conjugate_gradients.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

namespace swage {
namespace {

struct Problem {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd solution, right_hand_side;
};

/// A matrix with eigenvalues from 1 to `condition`.
Problem problem(int size, double condition) {
  const Eigen::MatrixXd random = Eigen::MatrixXd::Random(size, size);
  const Eigen::MatrixXd basis = random.householderQr().householderQ();
  Problem result;
  result.matrix = basis * Eigen::VectorXd::LinSpaced(size, 1, condition).asDiagonal() * basis.transpose();
  result.solution = Eigen::VectorXd::LinSpaced(size, -1, 2);
  result.right_hand_side = result.matrix * result.solution;
  return result;
}

Gradients solve(const Problem& p, const Eigen::MatrixXd& preconditioner, double tolerance, int limit,
                Eigen::VectorXd& x) {
  return conjugate_gradients(
      [&](const Eigen::VectorXd& v, Eigen::VectorXd& image) { image = p.matrix * v; },
      [&](const Eigen::VectorXd& residual, Eigen::VectorXd& error) { error = preconditioner.llt().solve(residual); },
      p.right_hand_side, tolerance, limit, x);
}

TEST(ConjugateGradients, SolvesInAsManyIterationsAsUnknownsAtMost) {
  const Problem p = problem(20, 50);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(20);
  const Gradients done = solve(p, Eigen::MatrixXd::Identity(20, 20), 1e-10, 200, x);
  EXPECT_TRUE(done.converged);
  EXPECT_LE(done.iterations, 21);
  EXPECT_LT((x - p.solution).norm(), 1e-9 * p.solution.norm());
}

TEST(ConjugateGradients, TheMatrixItselfAsPreconditionerTakesOneIteration) {
  const Problem p = problem(20, 1e6);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(20);
  EXPECT_EQ(solve(p, p.matrix, 1e-8, 25, x).iterations, 1);
  EXPECT_LT((x - p.solution).norm(), 1e-8 * p.solution.norm());
}

TEST(ConjugateGradients, AnExactGuessTakesNone) {
  const Problem p = problem(20, 50);
  Eigen::VectorXd x = p.solution;
  const Gradients done = solve({p.matrix, x, p.matrix * x}, Eigen::MatrixXd::Identity(20, 20), 1e-8, 25, x);
  EXPECT_TRUE(done.converged);
  EXPECT_EQ(done.iterations, 0);
  EXPECT_EQ(x, p.solution);
}

TEST(ConjugateGradients, GivesUpEarlyWhereTheLimitWouldNotDo) {
  const Problem p = problem(400, 1e6);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(400);
  const Gradients done = solve(p, Eigen::MatrixXd::Identity(400, 400), 1e-8, 20, x);
  EXPECT_FALSE(done.converged);
  EXPECT_LT(done.iterations, 20);
}

}  // namespace
}  // namespace swage
