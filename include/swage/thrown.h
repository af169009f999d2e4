// What a loop of several threads throws, out of memory for example. Past the end of a parallel region it would end the
// program.
#pragma once

#include <atomic>
#include <exception>

namespace swage {

class Thrown {
 public:
  /// Calls `work`, unless something was thrown before. Any number of threads at once.
  template <typename Work>
  void keep(const Work& work) noexcept {
    if (any_.load(std::memory_order_relaxed)) return;
    try {
      work();
    } catch (...) {
      if (!any_.exchange(true)) first_ = std::current_exception();
    }
  }

  /// Behind the region: throws what was thrown first.
  void rethrow() const {
    if (first_) std::rethrow_exception(first_);
  }

 private:
  std::atomic<bool> any_ = false;
  std::exception_ptr first_;
};

}  // namespace swage
