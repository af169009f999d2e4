#include "words.h"

#include "swage/error.h"

namespace swage {
namespace {

std::string meaning(cl_int code) {
  switch (code) {
    case CL_MEM_OBJECT_ALLOCATION_FAILURE:
    case CL_OUT_OF_RESOURCES:
      return "the device is out of memory: take a smaller mesh, another device or the cpu backend";
    case CL_OUT_OF_HOST_MEMORY:
      return "the host is out of memory: take a smaller mesh";
    case CL_INVALID_BUFFER_SIZE:
      return "the device holds no array that large: take a smaller mesh, another device or the cpu backend";
    case CL_DEVICE_NOT_AVAILABLE:
      return "the device is not available: take another or the cpu backend";
    case CL_COMPILER_NOT_AVAILABLE:
      return "the device has no compiler: take another or the cpu backend";
    default:
      return "the device refused: take another or the cpu backend";
  }
}

}  // namespace

void refuse(const std::string& asked, const cl::Error& error) {
  throw Unavailable(asked + ": " + meaning(error.err()) + " (" + error.what() + ", OpenCL error " +
                    std::to_string(error.err()) + ")");
}

}  // namespace swage
