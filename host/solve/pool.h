// Things that one thread at a time works with, kept for whoever works next.
#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace swage {

/// Holds as many as were ever lent at once. Threads may share it.
template <typename T>
class Pool {
 public:
  /// One of the pool's, back in it when this ends; the pool must live longer.
  class Lease {
   public:
    Lease(Pool& pool, std::unique_ptr<T> lent) : pool_(pool), lent_(std::move(lent)) {}
    ~Lease() { pool_.take_back(std::move(lent_)); }
    Lease(const Lease&) = delete;
    Lease& operator=(const Lease&) = delete;
    T& operator*() const { return *lent_; }
    T* operator->() const { return lent_.get(); }

   private:
    Pool& pool_;
    std::unique_ptr<T> lent_;
  };

  /// One that was given back, as its last user left it, or, where none is, what `make` gives: a std::unique_ptr<T>.
  template <typename Make>
  Lease lend(const Make& make) {
    std::unique_ptr<T> one = kept();
    if (!one) {
      one = make();
      const std::lock_guard lock(mutex_);
      kept_.reserve(++made_);  // So that no lease ends in want of memory.
    }
    return {*this, std::move(one)};
  }

 private:
  std::unique_ptr<T> kept() {
    const std::lock_guard lock(mutex_);
    if (kept_.empty()) return nullptr;
    std::unique_ptr<T> last = std::move(kept_.back());
    kept_.pop_back();
    return last;
  }

  void take_back(std::unique_ptr<T> one) {
    const std::lock_guard lock(mutex_);
    kept_.push_back(std::move(one));
  }

  std::mutex mutex_;
  std::vector<std::unique_ptr<T>> kept_;
  std::size_t made_ = 0;
};

}  // namespace swage
