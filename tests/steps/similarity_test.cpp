// The similarity step: what its result must be, by every backend.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

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
  double tolerance;
};

const Who kWho[] = {
    {"cpu", [] { return cpu_backend(); }, 1e-12},
    {"opencl_single", [] { return test::opencl_or_skip(Precision::single); }, 1e-5},
    {"opencl_double", [] { return test::opencl_or_skip(Precision::twice); }, 1e-9},
};

class SimilarityStepBy : public testing::TestWithParam<Who> {
 protected:
  void SetUp() override { backend_ = GetParam().backend(); }

  Transforms fit(const test::PairsCase& of) const {
    Transforms similarities;
    backend_->similarity(of.rest)->fit(of.positions, of.targets, similarities);
    return similarities;
  }

  std::shared_ptr<Backend> backend_;
};

double spread(const PairsRest& rest, Index element) {
  const auto at = static_cast<size_t>(element);
  double sum = 0;
  for (int p = rest.offsets[at]; p < rest.offsets[at + 1]; ++p) {
    sum += rest.weights[p] * (rest.vertices.row(rest.pairs(p, 1)) - rest.vertices.row(rest.pairs(p, 0))).squaredNorm();
  }
  return sum;
}

/// tr Rᵀ M of the rotation step's reference.
Eigen::VectorXd best_traces(const test::PairsCase& of) {
  Transforms rotations;
  cpu_backend()->rotation(of.rest)->fit(of.positions, of.targets, rotations);
  Eigen::VectorXd traces(rotations.rows());
  for (Index i = 0; i < traces.size(); ++i) {
    traces[i] = test::matrix(rotations, i).cwiseProduct(test::covariance(of, i)).sum();
  }
  return traces;
}

TEST_P(SimilarityStepBy, GivesTheBestRotationTimesTheBestScale) {
  if (!backend_) return;
  for (const test::PairsCase& of : test::pairs_cases()) {
    const Transforms similarities = fit(of);
    const Eigen::VectorXd traces = best_traces(of);
    ASSERT_EQ(similarities.rows(), traces.size());
    for (Index i = 0; i < traces.size(); ++i) {
      const Matrix3d S = test::matrix(similarities, i);
      const double scale = std::cbrt(S.determinant()), size = test::covariance_size(of, i);
      const double tolerance = GetParam().tolerance;
      ASSERT_TRUE(scale >= 0) << of.name << ", element " << i;
      if (scale == 0) continue;
      const Matrix3d R = S / scale;
      ASSERT_LT((R.transpose() * R - Matrix3d::Identity()).norm(), 10 * tolerance) << of.name << ", element " << i;
      ASSERT_GE(R.cwiseProduct(test::covariance(of, i)).sum(), traces[i] - tolerance * size) << of.name;
      const double along = R.cwiseProduct(test::covariance(of, i, false)).sum(), all = spread(of.rest, i);
      if (all > 0) {
        ASSERT_NEAR(scale * all, std::max(along, 0.0), 10 * tolerance * (size + all)) << of.name << i;
      }
    }
  }
}

TEST_P(SimilarityStepBy, FindsTheSizeOfAScaledMesh) {
  if (!backend_) return;
  const PairsRest rest = test::with_negative_weights(test::triangle_pairs(test::torus()));
  for (const double scale : {0.25, 1.0, 3.0}) {
    const Transforms similarities = fit({"", rest, scale * rest.vertices, Positions(0, 3)});
    for (Index i = 0; i < similarities.rows(); ++i) {
      ASSERT_NEAR(std::cbrt(test::matrix(similarities, i).determinant()), scale, 1e-4 * scale);
    }
  }
}

TEST_P(SimilarityStepBy, IsOneWithoutEdgesAndNothingWhereEdgesVanish) {
  if (!backend_) return;
  PairsRest rest = test::triangle_pairs(test::sheet(2));
  rest.offsets = {0, 0, 3};
  const Transforms similarities = fit({"", rest, 0 * rest.vertices, Positions(0, 3)});
  EXPECT_EQ(test::matrix(similarities, 0), Matrix3d::Identity());
  EXPECT_EQ(test::matrix(similarities, 1), Matrix3d::Zero());
}

TEST_P(SimilarityStepBy, ManyElements) {
  if (!backend_) return;
  const PairsRest rest = test::triangle_pairs(test::torus(1, 0.4, 1000, 500));
  ASSERT_EQ(rest.offsets.size(), 1'000'001u);
  const Transforms similarities = fit({"", rest, 2.5 * rest.vertices, Positions(0, 3)});
  for (Index i = 0; i < similarities.rows(); i += 37) {
    ASSERT_LT((test::matrix(similarities, i) - 2.5 * Matrix3d::Identity()).norm(), 1e-3) << "element " << i;
  }
}

TEST_P(SimilarityStepBy, GivesTheSameBytesAgain) {
  if (!backend_) return;
  for (const test::PairsCase& of : test::pairs_cases()) EXPECT_EQ(fit(of), fit(of)) << of.name;
}

INSTANTIATE_TEST_SUITE_P(Backends, SimilarityStepBy, testing::ValuesIn(kWho),
                         [](const auto& of) { return std::string(of.param.name); });

}  // namespace
}  // namespace swage
