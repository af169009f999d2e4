#include "host_rows.h"

#include <stdexcept>
#include <string>

#include "words.h"

namespace swage {

HostRows::HostRows(const Queue& queue, Eigen::Index size)
    : queue_(queue), size_(size), copy_(queue, queue.context->in_host_memory() ? 0 : size) {}

void HostRows::check(Eigen::Index size) const {
  if (size == size_) return;
  throw std::out_of_range("array of " + std::to_string(size) + " numbers of the host's where the step has " +
                          std::to_string(size_));
}

void HostRows::share(double* values, Eigen::Index size) {
  bytes_ = static_cast<std::size_t>(size) * sizeof(double);
  if (bytes_ == 0) return;
  shared_ = ask("array of the host's", [&] {
    return cl::Buffer(queue_.context->handle(), CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR, bytes_, values);
  });
}

void HostRows::wait_for_shared() {
  if (bytes_ == 0) return;
  ask("array of the host's", [&] {
    void* const seen = queue_.handle.enqueueMapBuffer(shared_, CL_TRUE, CL_MAP_READ, 0, bytes_);
    queue_.handle.enqueueUnmapMemObject(shared_, seen);
    return 0;
  });
}

Visit::~Visit() {
  try {
    queue_.handle.finish();
  } catch (const cl::Error&) {
    // The queue is broken: the next call that uses it says so.
  }
  for (HostRows* const rows : seen_) {
    rows->shared_ = cl::Buffer();
    rows->bytes_ = 0;
  }
}

}  // namespace swage
