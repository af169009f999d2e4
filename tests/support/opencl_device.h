// The OpenCL device that tests run on.
#pragma once

#include <memory>

#include "swage/backend.h"

namespace swage::test {

/// The backend on the first usable device. Null where there is none, the running test then skipped; failed where
/// SWAGE_REQUIRE_OPENCL=1 stands in the environment. Callers return when they get null.
std::shared_ptr<Backend> opencl_or_skip(Precision precision = Precision::twice);

/// Whether steps see the host's numbers rounded: in single precision on a device with memory of its own, a GPU.
bool sees_rounded(const Backend& backend);

}  // namespace swage::test
