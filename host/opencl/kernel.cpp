#include "kernel.h"

namespace swage {
namespace {

/// PoCL vectorises over a group and is several times slower with groups that do not fit the global size.
constexpr std::size_t kGroup = 64;

}  // namespace

Kernel::Kernel(const Queue& queue, const std::string& stem, const std::string& name)
    : Kernel(queue, queue.context->program(stem), name) {}

Kernel::Kernel(const Queue& queue, const cl::Program& program, const std::string& name)
    : queue_(queue), kernel_(ask("kernel " + name, [&] { return cl::Kernel(program, name.c_str()); })) {}

void Kernel::set(cl_uint place, double value) {
  if (queue_.context->precision() == Precision::single) {
    kernel_.setArg(place, static_cast<float>(value));
  } else {
    kernel_.setArg(place, value);
  }
}

void Kernel::enqueue(std::size_t count) {
  const std::size_t padded = (count + kGroup - 1) / kGroup * kGroup;
  ask("kernel launch", [&] { return queue_.handle.enqueueNDRangeKernel(kernel_, {}, padded, kGroup); });
}

}  // namespace swage
