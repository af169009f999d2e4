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

struct Authors {
  const char* model;
  const char* gesture;
};

void PrintTo(const Authors& authors, std::ostream* out) { *out << authors.model << " " << authors.gesture; }

const Authors kGestures[] = {
    {"cylinder_1kF", "def_v0"}, {"cylinder_1kF", "def_v1"},  {"cylinder_1kF", "def_v2"},   {"cylinder_1kF", "def_v3"},
    {"phone", "def_v1"},        {"cutlery_s26-1", "def_v1"}, {"e_car_extruded", "def_v1"}, {"espresso", "def_v1"},
};

class ReferenceGestureOnADevice : public testing::TestWithParam<Authors> {
 protected:
  void SetUp() override {
    if (!test::has_shared()) GTEST_SKIP() << "the reference results are not here";
    authors_ = test::authors_gesture(GetParam().model, GetParam().gesture, ReshapeOptions::published());
  }

  ReshapeResult result(std::shared_ptr<Backend> backend) {
    authors_.options.backend = std::move(backend);
    return reshape(authors_.mesh.positions, authors_.mesh.triangles, authors_.gesture, authors_.options);
  }

  void expect_the_references(Precision precision, double tolerance) {
    const auto backend = test::opencl_or_skip(precision);
    if (!backend) return;
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

TEST_P(ReferenceGestureOnADevice, IsTheSameInDouble) { expect_the_references(Precision::twice, 1e-9); }
TEST_P(ReferenceGestureOnADevice, IsTheSameInSingle) { expect_the_references(Precision::single, 2e-5); }

TEST_P(ReferenceGestureOnADevice, SteadyIsTheSame) {
  authors_.options = test::authors_gesture(GetParam().model, GetParam().gesture, {}).options;
  expect_the_references(Precision::twice, 1e-6);
  expect_the_references(Precision::single, 2e-5);
}

INSTANTIATE_TEST_SUITE_P(Authors, ReferenceGestureOnADevice, testing::ValuesIn(kGestures), [](const auto& named) {
  std::string name = std::string(named.param.model) + "_" + named.param.gesture;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace swage
