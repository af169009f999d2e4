#include "buffer.h"

#include <limits>
#include <stdexcept>

#include "swage/error.h"
#include "words.h"

namespace swage {
namespace {

cl::Buffer allocate(const Queue& queue, std::size_t count, std::size_t bytes_each) {
  const std::size_t bytes = count * bytes_each;
  const std::string asked = "device array of " + std::to_string(bytes) + " bytes";
  const auto largest = queue.context->device().getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
  // Kernels count in int.
  if (bytes > largest || count > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw Unavailable(asked + ": the device takes " + std::to_string(largest) +
                      " at most: take a smaller mesh, another device or the cpu backend");
  }
  return ask(asked, [&] {
    return cl::Buffer(queue.context->handle(), CL_MEM_READ_WRITE, std::max<std::size_t>(bytes, bytes_each));
  });
}

std::size_t bytes_of_real(const Queue& queue) {
  return queue.context->precision() == Precision::single ? sizeof(float) : sizeof(double);
}

}  // namespace

Buffer::Buffer(const Queue& queue, std::size_t count, std::size_t bytes_each)
    : queue_(queue),
      count_(count),
      bytes_each_(bytes_each),
      claim_(queue.context->claim(count * bytes_each)),
      handle_(allocate(queue, count, bytes_each)) {}

Buffer::View::View(const Buffer& buffer, std::size_t bytes, cl_map_flags flags)
    : buffer_(buffer), data_(ask("device array", [&] {
        return buffer.queue_.handle.enqueueMapBuffer(buffer.handle_, CL_TRUE, flags, 0, bytes);
      })) {}

Buffer::View::~View() {
  try {
    buffer_.queue_.handle.enqueueUnmapMemObject(buffer_.handle_, data_);
  } catch (const cl::Error&) {
    // The queue is broken: the next call that uses it says so.
  }
}

Buffer::View Buffer::writable(std::size_t count) {
  check(count);
  queue_.context->count_upload(count * bytes_each_);
  return {*this, count * bytes_each_, CL_MAP_WRITE_INVALIDATE_REGION};
}

Buffer::View Buffer::readable(std::size_t count) const {
  check(count);
  queue_.context->count_download(count * bytes_each_);
  return {*this, count * bytes_each_, CL_MAP_READ};
}

void Buffer::check(std::size_t count) const {
  if (count > count_) {
    throw std::out_of_range("device array of " + std::to_string(count_) + " used as one of " + std::to_string(count));
  }
}

Reals::Reals(const Queue& queue, Eigen::Index count)
    : Buffer(queue, static_cast<std::size_t>(count), bytes_of_real(queue)) {}

Ints::Ints(const Queue& queue, Eigen::Index count) : Buffer(queue, static_cast<std::size_t>(count), sizeof(int)) {}

Ints::Ints(const Queue& queue, const std::vector<int>& list)
    : Ints(queue, Eigen::Map<const Eigen::VectorXi>(list.data(), static_cast<Eigen::Index>(list.size()))) {}

}  // namespace swage
