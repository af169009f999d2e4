#include "devices.h"

#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <tuple>

#include "swage/error.h"

namespace swage {
namespace {

std::string kind_of(cl_device_type type) {
  if (type & CL_DEVICE_TYPE_GPU) return "gpu";
  if (type & CL_DEVICE_TYPE_ACCELERATOR) return "accelerator";
  return "cpu";
}

/// In words.
std::string missing_in(const cl::Device& device) {
  if (!device.getInfo<CL_DEVICE_AVAILABLE>()) return "is not available";
  if (!device.getInfo<CL_DEVICE_COMPILER_AVAILABLE>()) return "has no compiler";
  if (!device.getInfo<CL_DEVICE_ENDIAN_LITTLE>()) return "is big-endian";
  if (device.getInfo<CL_DEVICE_VERSION>() < "OpenCL 1.2") return "has an OpenCL before 1.2";
  return {};
}

FoundDevice describe(const cl::Device& device, const std::string& platform) {
  Device facts;
  facts.name = device.getInfo<CL_DEVICE_NAME>();
  facts.platform = platform;
  facts.driver = device.getInfo<CL_DRIVER_VERSION>();
  facts.kind = kind_of(device.getInfo<CL_DEVICE_TYPE>());
  facts.compute_units = static_cast<int>(device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>());
  facts.memory = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
  facts.largest_buffer = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
  facts.computes_twice = device.getInfo<CL_DEVICE_DOUBLE_FP_CONFIG>() != 0;
  facts.missing = missing_in(device);
  return {facts, device};
}

/// A platform without devices throws as much as none at all: either way there is nothing to describe.
void describe_all(std::vector<FoundDevice>& found) try {
  std::vector<cl::Platform> platforms;
  cl::Platform::get(&platforms);
  for (const cl::Platform& platform : platforms) {
    try {
      std::vector<cl::Device> devices;
      platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
      for (const cl::Device& device : devices) found.push_back(describe(device, platform.getInfo<CL_PLATFORM_NAME>()));
    } catch (const cl::Error&) {
      continue;
    }
  }
} catch (const cl::Error&) {
}

auto preference(const Device& device) {
  const int kind = device.kind == "gpu" ? 0 : device.kind == "accelerator" ? 1 : 2;
  return std::tuple(!device.missing.empty(), kind, -device.compute_units);
}

/// Made where missing; nobody else may have put programs there.
bool is_our_folder(const std::string& path) {
  struct stat facts {};
  mkdir(path.c_str(), S_IRWXU);
  return lstat(path.c_str(), &facts) == 0 && S_ISDIR(facts.st_mode) && facts.st_uid == geteuid() &&
         (facts.st_mode & (S_IRWXG | S_IRWXO)) == 0;
}

/// For PoCL, before it starts; what the user set stands.
void prepare_environment() {
  // One binary for grids of all sizes, which is the one that a kept program has: a kernel's first launch, and its first
  // large one, compile nothing again (0.4 s), at the same speed.
  setenv("POCL_WORK_GROUP_SPECIALIZATION", "0", 0);
  // Where it cannot write its cache it has no device, and says nothing.
  const char* const caches = getenv("XDG_CACHE_HOME");
  const char* const parent = caches != nullptr ? caches : getenv("HOME");
  if (parent == nullptr || access(parent, W_OK) == 0) return;
  const std::string folder = std::filesystem::temp_directory_path() / ("swage-pocl-" + std::to_string(geteuid()));
  if (is_our_folder(folder)) setenv("POCL_CACHE_DIR", folder.c_str(), 0);
}

std::vector<FoundDevice> look() {
  prepare_environment();
  std::vector<FoundDevice> found;
  describe_all(found);
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return preference(a.facts) < preference(b.facts); });
  for (size_t i = 0; i < found.size(); ++i) found[i].facts.index = static_cast<int>(i);
  return found;
}

std::string list_of_devices() {
  if (found_devices().empty()) return "there is no OpenCL device";
  std::string list = "there is";
  for (const FoundDevice& device : found_devices()) {
    list += (device.facts.index == 0 ? " " : ", ") + std::to_string(device.facts.index) + ": " + device.facts.name;
  }
  return list;
}

bool fits(const Device& device, const std::string& wanted) {
  if (wanted.empty()) return device.missing.empty();
  return wanted == std::to_string(device.index) || device.name.find(wanted) != std::string::npos;
}

}  // namespace

const std::vector<FoundDevice>& found_devices() {
  // Never destroyed: at the end of the process a runtime may be gone before its handles.
  static const auto* const kFound = new std::vector<FoundDevice>(look());  // NOLINT(cppcoreguidelines-owning-memory)
  return *kFound;
}

const FoundDevice& choose_device(const std::string& wanted, Precision precision) {
  const auto& all = found_devices();
  const auto chosen = std::find_if(all.begin(), all.end(), [&](const auto& d) { return fits(d.facts, wanted); });
  if (chosen == all.end()) {
    throw Unavailable(
        (wanted.empty() ? "no OpenCL device can be used" : "no OpenCL device is called \"" + wanted + '"') + ": " +
        list_of_devices() + ": name another, or take the cpu backend");
  }
  const Device& facts = chosen->facts;
  if (!facts.missing.empty())
    throw Unavailable("OpenCL device " + facts.name + ' ' + facts.missing + ": take another, or the cpu backend");
  if (precision == Precision::twice && !facts.computes_twice) {
    throw Unavailable("OpenCL device " + facts.name + " has no double precision: ask for single");
  }
  return *chosen;
}

bool keeps_programs(const Device& device) {
  // PoCL does as well, but finds them only after it has read its headers again (30 ms a program); a binary needs none.
  return device.platform == "NVIDIA CUDA";
}

std::vector<Device> opencl_devices() {
  std::vector<Device> devices;
  for (const FoundDevice& device : found_devices()) devices.push_back(device.facts);
  return devices;
}

}  // namespace swage
