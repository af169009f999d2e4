// Devices as a person sees and names them.
#include "devices.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "opencl_device.h"
#include "swage/error.h"

namespace swage {
namespace {

using testing::HasSubstr;

std::string refusal(const std::string& device, Precision precision = Precision::single) {
  try {
    opencl_backend(device, precision);
  } catch (const Unavailable& refused) {
    return refused.what();
  }
  return "not refused";
}

class Devices : public testing::Test {
 protected:
  void SetUp() override { test::opencl_or_skip(Precision::single); }
};

TEST_F(Devices, AreDescribed) {
  const std::vector<Device> devices = opencl_devices();
  ASSERT_FALSE(devices.empty());
  for (std::size_t i = 0; i < devices.size(); ++i) {
    EXPECT_EQ(devices[i].index, static_cast<int>(i));
    EXPECT_FALSE(devices[i].name.empty());
    EXPECT_FALSE(devices[i].platform.empty());
    EXPECT_FALSE(devices[i].driver.empty());
    EXPECT_THAT(devices[i].kind, testing::AnyOf("cpu", "gpu", "accelerator"));
    EXPECT_GT(devices[i].compute_units, 0);
    EXPECT_GE(devices[i].memory, devices[i].largest_buffer);
    EXPECT_GT(devices[i].largest_buffer, std::size_t{1} << 20);
  }
}

TEST_F(Devices, UsableOnesComeFirst) {
  const std::vector<Device> devices = opencl_devices();
  EXPECT_TRUE(std::is_partitioned(devices.begin(), devices.end(), [](const Device& d) { return d.missing.empty(); }));
}

TEST_F(Devices, AreChosenByIndexOrPartOfTheName) {
  const Device first = opencl_devices().front();
  EXPECT_EQ(opencl_backend("0", Precision::single)->device(), first.name);
  EXPECT_EQ(opencl_backend(first.name.substr(1, 5), Precision::single)->device(), first.name);
  EXPECT_EQ(opencl_backend("", Precision::single)->device(), first.name);
  EXPECT_EQ(opencl_backend("", Precision::single)->name(), "opencl");
}

TEST_F(Devices, AWrongNameIsToldWhatThereIs) {
  EXPECT_THAT(refusal("Abacus"), HasSubstr("Abacus"));
  EXPECT_THAT(refusal("Abacus"), HasSubstr("0: " + opencl_devices().front().name));
  EXPECT_THAT(refusal("99"), HasSubstr("99"));
  EXPECT_THAT(refusal("-1"), HasSubstr("-1"));
}

TEST_F(Devices, DoubleIsRefusedWhereTheDeviceHasNone) {
  for (const Device& device : opencl_devices()) {
    if (device.computes_twice || !device.missing.empty()) continue;
    EXPECT_THAT(refusal(std::to_string(device.index), Precision::twice), HasSubstr("double"));
  }
}

}  // namespace
}  // namespace swage
