// The authors' gestures with all local steps on a device: as the reference backend does them, which
// reshape_reference_test.cpp holds to the authors' own results.
#include <gtest/gtest.h>

#include <algorithm>

#include "authors.h"
#include "edit_measures.h"
#include "opencl_device.h"
#include "places.h"
#include "swage/reshape.h"

namespace swage {
namespace {

class ReferenceGestureOnADevice : public testing::TestWithParam<test::AuthorsName> {
 protected:
  void SetUp() override {
    if (!test::has_shared()) GTEST_SKIP() << "the reference results are not here";
  }

  ReshapeResult result(std::shared_ptr<Backend> backend) {
    authors_.options.backend = std::move(backend);
    return reshape(authors_.mesh.positions, authors_.mesh.triangles, authors_.gesture, authors_.options);
  }

  void expect_the_references(ReshapeSolver solver, Precision precision, double tolerance) {
    const auto backend = test::opencl_or_skip(precision);
    if (!backend) return;
    authors_ = test::authors_gesture(GetParam().model, GetParam().gesture, solver);
    const ReshapeResult expected = result(cpu_backend()), device = result(backend);
    EXPECT_EQ(device.report.stop, expected.report.stop);
    EXPECT_EQ(device.report.passes, expected.report.passes);
    EXPECT_EQ(device.report.best_pass, expected.report.best_pass);
    EXPECT_EQ(device.finalised, expected.finalised);
    const double deviation = test::deviation(expected.positions, device.positions).largest;
    EXPECT_LT(deviation, tolerance);
    RecordProperty("deviation_in_diagonals", std::to_string(deviation * 1e9) + "e-9");
  }

  test::AuthorsGesture authors_;
};

TEST_P(ReferenceGestureOnADevice, IsTheSameInDouble) {
  expect_the_references(ReshapeSolver::published, Precision::twice, 1e-9);
}
TEST_P(ReferenceGestureOnADevice, IsTheSameInSingle) {
  expect_the_references(ReshapeSolver::published, Precision::single, 2e-5);
}
// Where passes stop is decided at L / 1000, not at rounding.
TEST_P(ReferenceGestureOnADevice, SteadyIsTheSameInDouble) {
  expect_the_references(ReshapeSolver::steady, Precision::twice, 1e-6);
}
TEST_P(ReferenceGestureOnADevice, SteadyIsTheSameInSingle) {
  expect_the_references(ReshapeSolver::steady, Precision::single, 2e-5);
}

INSTANTIATE_TEST_SUITE_P(Authors, ReferenceGestureOnADevice, testing::ValuesIn(test::authors_names()),
                         [](const auto& named) { return test::test_name(named.param.model, named.param.gesture); });

}  // namespace
}  // namespace swage
