// The closest_normal step: what its result must be, by every backend.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "measures.h"
#include "opencl_device.h"
#include "shapes.h"

namespace swage {
namespace {

using Eigen::Index;

struct Who {
  const char* name;
  std::shared_ptr<Backend> (*backend)();
};

const Who kWho[] = {
    {"cpu", [] { return cpu_backend(); }},
    {"opencl_single", [] { return test::opencl_or_skip(Precision::single); }},
    {"opencl_double", [] { return test::opencl_or_skip(Precision::twice); }},
};

// Of cosines: the device may see the host's doubles only rounded.
constexpr double kRounding = 2e-7;

Positions units_about(const Eigen::RowVector3d& centre, double spread, Index count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Positions units(count, 3);
  for (Index i = 0; i < units.size(); ++i) units.data()[i] = spread * normal(random);
  units.rowwise() += centre;
  return normalised(units);
}

Positions none_apart(Index count) { return units_about({0, 0, 0}, 1, count, 3); }
/// As of a scanned cube: six directions and a little noise.
Positions clustered() {
  Positions all(6000, 3);
  for (int k = 0; k < 6; ++k) {
    all.middleRows(1000 * k, 1000) =
        units_about(Eigen::RowVector3d::Unit(k % 3) * (k < 3 ? 1 : -1), 1e-3, 1000, static_cast<unsigned>(k));
  }
  return all;
}

class ClosestNormalStepBy : public testing::TestWithParam<Who> {
 protected:
  void SetUp() override { backend_ = GetParam().backend(); }

  Eigen::VectorXi find(const Positions& normals, const Positions& units) const {
    Eigen::VectorXi closest;
    backend_->closest_normal(normals)->find(units, closest);
    return closest;
  }

  std::shared_ptr<Backend> backend_;
};

TEST_P(ClosestNormalStepBy, NoneIsCloser) {
  if (!backend_) return;
  const Positions units = none_apart(2000);
  for (const Positions& normals : {none_apart(1), none_apart(6), none_apart(64), none_apart(65), none_apart(10000),
                                   clustered(), units_about({0, 0, 1}, 0.01, 5000, 7)}) {
    const Eigen::VectorXi closest = find(normals, units);
    ASSERT_EQ(closest.size(), units.rows());
    for (Index n = 0; n < units.rows(); ++n) {
      ASSERT_TRUE(closest[n] >= 0 && closest[n] < normals.rows());
      const double best = (normals * units.row(n).transpose()).maxCoeff();
      ASSERT_GE(normals.row(closest[n]).dot(units.row(n)), best - kRounding)
          << normals.rows() << " normals, unit vector " << n;
    }
  }
}

TEST_P(ClosestNormalStepBy, FindsEachOfItsOwn) {
  if (!backend_) return;
  const Positions normals = none_apart(10000);
  const Eigen::VectorXi closest = find(normals, normals);
  for (Index n = 0; n < normals.rows(); ++n) {
    if (test::sees_rounded(*backend_)) {
      ASSERT_GE(normals.row(closest[n]).dot(normals.row(n)), 1 - kRounding);
    } else {
      ASSERT_EQ(closest[n], n);
    }
  }
}

TEST_P(ClosestNormalStepBy, TakesTheFirstOfSeveralEquallyNear) {
  if (!backend_) return;
  Positions corners(8, 3);
  for (int k = 0; k < 8; ++k) corners.row(k) << (k & 4 ? 1 : -1), (k & 2 ? 1 : -1), (k & 1 ? 1 : -1);
  corners /= std::sqrt(3.0);
  Positions axes(6, 3);
  axes << 1, 0, 0, 0, 1, 0, 0, 0, 1, -1, 0, 0, 0, -1, 0, 0, 0, -1;
  const Eigen::VectorXi closest = find(corners, axes);
  EXPECT_EQ(closest, (Eigen::VectorXi(6) << 4, 2, 1, 0, 0, 0).finished());
  const Positions twice = corners.replicate(20, 1);  // Enough for a tree.
  EXPECT_EQ(find(twice, corners), Eigen::VectorXi::LinSpaced(8, 0, 7));
}

TEST_P(ClosestNormalStepBy, GivesAnyLengthOfListAndRowsOfZeros) {
  if (!backend_) return;
  const Positions normals = none_apart(100);
  const auto step = backend_->closest_normal(normals);
  Eigen::VectorXi closest;
  for (const Index count : {7, 3, 0, 20}) {
    Positions units = normals.topRows(count);
    if (count == 20) units.row(5).setZero();
    step->find(units, closest);
    ASSERT_EQ(closest.size(), count);
    for (Index n = 0; n < count; ++n) EXPECT_EQ(closest[n], count == 20 && n == 5 ? 0 : n);
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, ClosestNormalStepBy, testing::ValuesIn(kWho),
                         [](const auto& of) { return std::string(of.param.name); });

}  // namespace
}  // namespace swage
