// Which backend does the local steps: --backend, --device, --precision, SWAGE_BACKEND and SWAGE_DEVICE.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "options.h"
#include "swage/backend.h"

namespace swage::cli {

/// What `auto` may take. A step whose reference computes singular values gains on a CPU's vector units too.
enum class AutoDevices { no_cpus, all };

/// Triangles, vertices or points; `auto` leaves fewer to the cpu: they are done before a device has built its kernels.
inline constexpr int kElementsForDevice = 100000;

class BackendChoice {
 public:
  /// Throws WrongUsage where there is no backend of that name, Unavailable where opencl is asked for and not to be had.
  explicit BackendChoice(const CommonOptions& common);

  /// What `auto` comes to. Falls back to the cpu with a warning.
  std::shared_ptr<Backend> for_elements(int count, AutoDevices devices = AutoDevices::no_cpus) const;

  bool is_auto() const { return name_ == "auto"; }

 private:
  std::shared_ptr<Backend> on_device(AutoDevices devices) const;

  std::string name_, device_, precision_;
  std::shared_ptr<Backend> asked_for_;  ///< Null where auto.
};

/// The device that `auto` takes for large meshes: the one SWAGE_DEVICE names, else the first usable one.
std::optional<Device> device_of_auto(AutoDevices devices = AutoDevices::no_cpus);

}  // namespace swage::cli
