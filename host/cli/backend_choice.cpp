#include "backend_choice.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "failure.h"
#include "swage/error.h"

namespace swage::cli {
namespace {

std::string or_environment(const std::string& option, const char* variable) {
  const char* const value = std::getenv(variable);
  return option.empty() && value != nullptr ? value : option;
}

/// A device named on the command line asks for OpenCL, unless --backend says more.
std::string backend_name(const CommonOptions& common) {
  if (common.backend.empty() && !common.device.empty()) return "opencl";
  const std::string name = or_environment(common.backend, "SWAGE_BACKEND");
  return name.empty() ? "auto" : name;
}

/// In double where the device has it and no other is asked for.
std::shared_ptr<Backend> backend_on(const std::string& device, const std::string& precision) {
  if (precision == "single") return opencl_backend(device, Precision::single);
  try {
    return opencl_backend(device, Precision::twice);
  } catch (const Unavailable&) {
    if (precision == "double") throw;
    return opencl_backend(device, Precision::single);
  }
}

/// None where the build leaves OpenCL out: auto says nothing about that.
std::vector<Device> devices_of_build() {
  try {
    return opencl_devices();
  } catch (const Unavailable&) {
    return {};
  }
}

}  // namespace

BackendChoice::BackendChoice(const CommonOptions& common)
    : name_(backend_name(common)),
      device_(or_environment(common.device, "SWAGE_DEVICE")),
      precision_(common.precision) {
  if (name_ != "auto" && name_ != "cpu" && name_ != "opencl") {
    throw WrongUsage("--backend (or SWAGE_BACKEND) is '" + name_ + "': use auto, cpu or opencl");
  }
  if (name_ == "cpu" && !common.device.empty()) {
    throw WrongUsage("--device " + common.device + " names an OpenCL device, --backend cpu uses none: leave one out");
  }
  if (name_ == "cpu" && precision_ == "single") {
    throw WrongUsage("--precision single is for OpenCL devices, the cpu backend computes in double: leave one out");
  }
  if (name_ == "cpu") asked_for_ = cpu_backend();
  if (name_ == "opencl") asked_for_ = backend_on(device_, precision_);
}

std::shared_ptr<Backend> BackendChoice::for_elements(int count, AutoDevices devices) const {
  if (asked_for_) return asked_for_;
  return count < kElementsForDevice ? cpu_backend() : on_device(devices);
}

std::shared_ptr<Backend> BackendChoice::on_device(AutoDevices devices) const {
  try {
    if (!device_.empty()) return backend_on(device_, precision_);
    if (const auto device = device_of_auto(devices)) return backend_on(std::to_string(device->index), precision_);
  } catch (const Unavailable& reason) {
    spdlog::warn("the cpu does the local steps: {}", reason.what());
  }
  return cpu_backend();
}

std::optional<Device> device_of_auto(AutoDevices devices) {
  const std::string named = or_environment("", "SWAGE_DEVICE");
  const auto takes = [&](const Device& device) {
    if (!device.missing.empty()) return false;
    if (named.empty()) return devices == AutoDevices::all || device.kind != "cpu";
    return named == std::to_string(device.index) || device.name.find(named) != std::string::npos;
  };
  const std::vector<Device> all = devices_of_build();
  const auto first = std::find_if(all.begin(), all.end(), takes);
  return first == all.end() ? std::nullopt : std::optional(*first);
}

}  // namespace swage::cli
