// The devices of this machine.
#pragma once

#include <string>
#include <vector>

#include "cl.h"
#include "swage/backend.h"

namespace swage {

// NOLINTNEXTLINE(bugprone-exception-escape): cl::Device's move may throw where a release fails, and says noexcept.
struct FoundDevice {
  Device facts;
  cl::Device handle;
};

/// Looked for once, by one thread; in the order of opencl_devices().
const std::vector<FoundDevice>& found_devices();

/// As opencl_backend() chooses.
const FoundDevice& choose_device(const std::string& wanted, Precision precision);

/// Whether the device's platform keeps built programs on disk itself, and finds them quickly.
bool keeps_programs(const Device& device);

}  // namespace swage
