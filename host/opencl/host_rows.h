// The host's matrices that change from call to call.
#pragma once

#include <initializer_list>
#include <vector>

#include "buffer.h"

namespace swage {

/// A number as kernels take it for `host_scalar`.
struct HostNumber {
  double value;
};

/// A matrix of the host's, row after row, that kernels see as an array of `host_scalar`: where the device computes in
/// the host's memory it lies where the host has it; elsewhere on the device, and is copied there or back.
class HostRows {
 public:
  /// Of `size` numbers; with others, what follows throws std::out_of_range.
  HostRows(const Queue& queue, Eigen::Index size);

  /// For kernels to read.
  template <typename Matrix>
  void show(const Matrix& values) {
    static_assert(Matrix::IsRowMajor || Matrix::ColsAtCompileTime == 1);
    check(values.size());
    if (shared()) {
      share(const_cast<double*>(values.data()), values.size());  // Kernels take it as const.
      queue_.context->count_upload(bytes_);
    } else {
      copy_.upload(values, Layout::rows);
    }
  }

  /// For kernels to write.
  template <typename Matrix>
  void lend(Matrix& values) {
    static_assert(Matrix::IsRowMajor || Matrix::ColsAtCompileTime == 1);
    check(values.size());
    if (shared()) share(values.data(), values.size());
  }

  /// What was lent, written. Waits.
  template <typename Matrix>
  void take_back(Matrix& values) {
    if (shared()) {
      wait_for_shared();
      queue_.context->count_download(bytes_);
    } else {
      copy_.download(values, Layout::rows);
    }
  }

  const cl::Buffer& handle() const { return bytes_ == 0 ? copy_.handle() : shared_; }

 private:
  friend class Visit;
  bool shared() const { return queue_.context->in_host_memory(); }
  void check(Eigen::Index size) const;
  void share(double* values, Eigen::Index size);
  void wait_for_shared();

  Queue queue_;
  Eigen::Index size_;
  Reals copy_;
  cl::Buffer shared_;
  std::size_t bytes_ = 0;  // Of what is shared.
};

/// Held over a call: when it ends, however it does, no kernel works on and nothing of the host's is kept.
class Visit {
 public:
  Visit(const Queue& queue, std::initializer_list<HostRows*> seen) : queue_(queue), seen_(seen) {}
  ~Visit();
  Visit(const Visit&) = delete;
  Visit& operator=(const Visit&) = delete;

 private:
  const Queue& queue_;
  std::vector<HostRows*> seen_;
};

}  // namespace swage
