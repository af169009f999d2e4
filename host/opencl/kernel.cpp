#include "kernel.h"

#include "kernel_source.h"

namespace swage {

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

void Kernel::set(cl_uint place, HostNumber number) {
  if (queue_.context->in_host_memory()) {
    kernel_.setArg(place, number.value);
  } else {
    set(place, number.value);
  }
}

void Kernel::enqueue(std::size_t count) {
  // Padded: some devices are several times slower with groups that do not fit the global size.
  constexpr std::size_t kSize = kGroup;
  const std::size_t padded = (count + kSize - 1) / kSize * kSize;
  ask("kernel launch", [&] { return queue_.handle.enqueueNDRangeKernel(kernel_, {}, padded, kSize); });
}

}  // namespace swage
