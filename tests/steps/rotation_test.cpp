// The rotation step: what its result must be, by every backend.
#include <gtest/gtest.h>
#ifdef _OPENMP
#include <omp.h>
#endif

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <thread>

#include "element_pairs.h"
#include "opencl_device.h"
#include "shapes.h"

namespace swage {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;

struct Who {
  const char* name;
  std::shared_ptr<Backend> (*backend)();
  double orthonormal;  // Of RᵀR.
  double loss;         // Of the trace, in parts of what it is the sum of.
};

const Who kWho[] = {
    {"cpu", [] { return cpu_backend(); }, 1e-12, 1e-12},
    {"opencl_single", [] { return test::opencl_or_skip(Precision::single); }, 1e-5, 1e-5},
    {"opencl_double", [] { return test::opencl_or_skip(Precision::twice); }, 1e-12, 1e-9},
};

class RotationStepBy : public testing::TestWithParam<Who> {
 protected:
  void SetUp() override { backend_ = GetParam().backend(); }

  Transforms fit(const test::PairsCase& of) const {
    Transforms rotations;
    backend_->rotation(of.rest)->fit(of.positions, of.targets, rotations);
    return rotations;
  }

  std::shared_ptr<Backend> backend_;
};

/// The largest tr Rᵀ M: the largest eigenvalue of Davenport's matrix, no singular values asked.
double best_trace(const Matrix3d& m) {
  Eigen::Matrix4d K;
  K(0, 0) = m.trace();
  K.block<3, 1>(1, 0) << m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1);
  K.block<3, 3>(1, 1) = m + m.transpose() - m.trace() * Matrix3d::Identity();
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(K, Eigen::EigenvaluesOnly).eigenvalues()[3];
}

void expect_best_rotations(const test::PairsCase& of, const Transforms& rotations, const Who& who, Index stride = 1) {
  for (Index i = 0; i < rotations.rows(); i += stride) {
    const Matrix3d R = test::matrix(rotations, i), M = test::covariance(of, i);
    ASSERT_LT((R.transpose() * R - Matrix3d::Identity()).norm(), who.orthonormal) << of.name << ", element " << i;
    ASSERT_GT(R.determinant(), 0) << of.name << ", element " << i;
    ASSERT_LE(best_trace(M) - R.cwiseProduct(M).sum(), who.loss * test::covariance_size(of, i))
        << of.name << ", element " << i;
  }
}

TEST_P(RotationStepBy, GivesTheBestProperRotations) {
  if (!backend_) return;
  for (const test::PairsCase& of : test::pairs_cases()) {
    const Transforms rotations = fit(of);
    EXPECT_EQ(rotations.rows(), of.rest.offsets.empty() ? 0 : static_cast<Index>(of.rest.offsets.size()) - 1);
    expect_best_rotations(of, rotations, GetParam());
  }
}

TEST_P(RotationStepBy, LeavesEmptyElementsAlone) {
  if (!backend_) return;
  PairsRest rest = test::triangle_pairs(test::sheet(2));
  rest.offsets = {0, 0, 3, 3};
  const Transforms rotations = fit({"", rest, rest.vertices, Positions(0, 3)});
  for (const Index i : {0, 2}) EXPECT_EQ(test::matrix(rotations, i), Matrix3d::Identity());
}

TEST_P(RotationStepBy, FollowsARigidMotion) {
  if (!backend_) return;
  const PairsRest rest = test::vertex_pairs(test::torus());
  Matrix3d R;
  R << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  const Positions positions = (rest.vertices * R.transpose()).rowwise() + Eigen::RowVector3d(1, 2, 3);
  const Transforms rotations = fit({"", rest, positions, Positions(0, 3)});
  // Vertices of a torus leave no choice.
  for (Index i = 0; i < rotations.rows(); ++i) ASSERT_LT((test::matrix(rotations, i) - R).norm(), 1e-4);
}

TEST_P(RotationStepBy, ManyElements) {
  if (!backend_) return;
  const Mesh mesh = test::torus(1, 0.4, 1000, 500);
  const PairsRest rest = test::triangle_pairs(mesh);
  ASSERT_EQ(rest.offsets.size(), 1'000'001u);
  test::PairsCase of{"a million", rest, (2 * mesh.positions).array().sin().matrix(), Positions(0, 3)};
  expect_best_rotations(of, fit(of), GetParam(), 37);
}

TEST_P(RotationStepBy, GivesTheSameBytesAgain) {
  if (!backend_) return;
  for (const test::PairsCase& of : test::pairs_cases()) {
    const auto step = backend_->rotation(of.rest);
    Transforms first, second;
    step->fit(of.positions, of.targets, first);
    step->fit(0.5 * of.positions, of.targets, second);
    step->fit(of.positions, of.targets, second);
    EXPECT_EQ(first, second) << of.name;
    EXPECT_EQ(first, fit(of)) << of.name;
  }
}

TEST_P(RotationStepBy, TwoStepsOnTwoThreads) {
  if (!backend_) return;
  const std::vector<test::PairsCase> cases = test::pairs_cases();
  const Transforms expected[] = {fit(cases[0]), fit(cases[1])};
  auto repeat = [&](size_t which) {
    const auto step = backend_->rotation(cases[which].rest);
    Transforms rotations;
    for (int i = 0; i < 20; ++i) {
      step->fit(cases[which].positions, cases[which].targets, rotations);
      EXPECT_EQ(rotations, expected[which]);
    }
  };
  std::thread other(repeat, 1);
  repeat(0);
  other.join();
}

INSTANTIATE_TEST_SUITE_P(Backends, RotationStepBy, testing::ValuesIn(kWho),
                         [](const auto& of) { return std::string(of.param.name); });

#ifdef _OPENMP
TEST(RotationStep, DoesNotDependOnTheThreads) {
  const test::PairsCase of = test::pairs_cases()[0];
  auto fit = [&](int threads) {
    omp_set_num_threads(threads);
    Transforms rotations;
    cpu_backend()->rotation(of.rest)->fit(of.positions, of.targets, rotations);
    return rotations;
  };
  const int threads = omp_get_max_threads();
  const Transforms alone = fit(1);
  EXPECT_EQ(fit(2), alone);
  EXPECT_EQ(fit(5), alone);
  omp_set_num_threads(threads);
}
#endif

}  // namespace
}  // namespace swage
