// The authors' gestures with all local steps on a device: as the reference backend does them, which
// reshape_reference_test.cpp holds to the authors' own results.
#include <gtest/gtest.h>

#include <algorithm>

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
    const std::string model = GetParam().model;
    const std::filesystem::path folder = test::shared("oracle/reshape/") / model;
    mesh_ = read_mesh(folder / (model + ".obj")).mesh;
    options_.unit_box_curvatures =
        read_unit_box_curvatures(folder / (model + ".fk"), static_cast<int>(mesh_.triangles.rows()));
    if (std::filesystem::exists(folder / (model + ".straight"))) {
      options_.straight_chains =
          read_straight_chains(folder / (model + ".straight"), static_cast<int>(mesh_.positions.rows()));
    }
    const std::vector<Gesture> gestures = read_gestures(folder / (model + ".deform"), mesh_.positions);
    const auto found = std::find_if(gestures.begin(), gestures.end(),
                                    [](const Gesture& gesture) { return gesture.label == GetParam().gesture; });
    ASSERT_NE(found, gestures.end());
    gesture_ = *found;
  }

  ReshapeResult result(std::shared_ptr<Backend> backend) {
    options_.backend = std::move(backend);
    return reshape(mesh_.positions, mesh_.triangles, gesture_, options_);
  }

  void expect_the_references(Precision precision, double tolerance) {
    const auto backend = test::opencl_or_skip(precision);
    if (!backend) return;
    const ReshapeResult expected = result(cpu_backend()), device = result(backend);
    EXPECT_EQ(device.report.stop, expected.report.stop);
    EXPECT_EQ(device.report.passes, expected.report.passes);
    EXPECT_EQ(device.report.best_pass, expected.report.best_pass);
    EXPECT_EQ(device.finalised, expected.finalised);
    const double diagonal = box_diagonal(mesh_.positions);
    const double deviation = (device.positions - expected.positions).rowwise().norm().maxCoeff() / diagonal;
    EXPECT_LT(deviation, tolerance);
    RecordProperty("deviation_in_diagonals", std::to_string(deviation * 1e9) + "e-9");
  }

  Mesh mesh_;
  ReshapeOptions options_ = ReshapeOptions::published();
  Gesture gesture_;
};

TEST_P(ReferenceGestureOnADevice, IsTheSameInDouble) { expect_the_references(Precision::twice, 1e-9); }
TEST_P(ReferenceGestureOnADevice, IsTheSameInSingle) { expect_the_references(Precision::single, 2e-5); }

INSTANTIATE_TEST_SUITE_P(Authors, ReferenceGestureOnADevice, testing::ValuesIn(kGestures), [](const auto& named) {
  std::string name = std::string(named.param.model) + "_" + named.param.gesture;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace swage
