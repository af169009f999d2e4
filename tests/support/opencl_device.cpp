#include "opencl_device.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "swage/error.h"

namespace swage::test {

std::shared_ptr<Backend> opencl_or_skip(Precision precision) {
  try {
    return opencl_backend("", precision);
  } catch (const Unavailable& reason) {
    const char* const required = std::getenv("SWAGE_REQUIRE_OPENCL");
    const bool fails = required != nullptr && std::string(required) == "1";
    [&] {
      if (fails) FAIL() << "SWAGE_REQUIRE_OPENCL=1, but " << reason.what();
      GTEST_SKIP() << reason.what();
    }();
    return nullptr;
  }
}

bool sees_rounded(const Backend& backend) {
  return backend.precision() == Precision::single && opencl_devices().front().kind != "cpu";
}

}  // namespace swage::test
