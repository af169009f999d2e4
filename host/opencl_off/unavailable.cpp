// Stands in for host/opencl where the build leaves it out.
#include "swage/backend.h"
#include "swage/error.h"

namespace swage {
namespace {

[[noreturn]] void refuse(const char* function) {
  throw Unavailable(std::string(function) + ": this build has no OpenCL; configure with -DSWAGE_OPENCL=ON");
}

}  // namespace

std::vector<Device> opencl_devices() { refuse("opencl_devices"); }

std::shared_ptr<Backend> opencl_backend(const std::string&, Precision) { refuse("opencl_backend"); }

}  // namespace swage
