// Arrays on a device.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <vector>

#include "context.h"

namespace swage {

/// How a matrix lies on the device: entry (i, k) of an n × m matrix at k * n + i or at i * m + k.
enum class Layout { columns, rows };

/// Bytes on the device, at least one. Throws Unavailable where the device has no room.
class Buffer {
 public:
  Buffer(const Queue& queue, std::size_t count, std::size_t bytes_each);

  std::size_t count() const { return count_; }
  Eigen::Index size() const { return static_cast<Eigen::Index>(count_); }
  const cl::Buffer& handle() const { return handle_; }

 protected:
  /// The array as the host sees it, for as long as this lives.
  class View {
   public:
    View(const Buffer& buffer, std::size_t bytes, cl_map_flags flags);
    ~View();
    View(const View&) = delete;
    View& operator=(const View&) = delete;
    void* data() const { return data_; }

   private:
    const Buffer& buffer_;
    void* data_;
  };

  /// What goes up or comes down is counted. Throw std::out_of_range beyond the array's end.
  View writable(std::size_t count);
  View readable(std::size_t count) const;
  Precision precision() const { return queue_.context->precision(); }

 private:
  void check(std::size_t count) const;

  Queue queue_;
  std::size_t count_, bytes_each_;
  std::shared_ptr<const std::size_t> claim_;
  cl::Buffer handle_;
};

/// to = from, converted, by blocks of rows that stay in the cache.
template <typename To, typename From>
void convert(const From& from, To&& to) {
  constexpr Eigen::Index kBlock = 256;
  // Threads that wait for the next loop take the cores from a device that is the same processor.
  constexpr Eigen::Index kWorthThreads = 20000;
  const Eigen::Index rows = from.rows();
#pragma omp parallel for schedule(static) if (rows > kWorthThreads)
  for (Eigen::Index b = 0; b < rows; b += kBlock) {
    const Eigen::Index size = std::min(kBlock, rows - b);
    to.middleRows(b, size) = from.middleRows(b, size).template cast<typename std::decay_t<To>::Scalar>();
  }
}

/// Calls `use` with the device's array seen as a matrix of that layout.
template <typename Scalar, int kColumns, typename Use>
void see(void* data, Eigen::Index rows, Eigen::Index columns, Layout layout, const Use& use) {
  using Eigen::Dynamic;
  constexpr int kRowOrder = kColumns == 1 ? Eigen::ColMajor : Eigen::RowMajor;
  auto* scalars = static_cast<Scalar*>(data);
  // NOLINTNEXTLINE(bugprone-branch-clone): the branches differ in their type.
  if (layout == Layout::columns) {
    use(Eigen::Map<Eigen::Matrix<Scalar, Dynamic, kColumns>>(scalars, rows, columns));
  } else {
    use(Eigen::Map<Eigen::Matrix<Scalar, Dynamic, kColumns, kRowOrder>>(scalars, rows, columns));
  }
}

/// Numbers, double on the host and in the context's precision on the device.
class Reals : public Buffer {
 public:
  Reals(const Queue& queue, Eigen::Index count);

  template <typename Derived>
  Reals(const Queue& queue, const Eigen::DenseBase<Derived>& values, Layout layout = Layout::columns)
      : Reals(queue, values.size()) {
    upload(values, layout);
  }

  /// Any expression; may be smaller than the array.
  template <typename Derived>
  void upload(const Eigen::DenseBase<Derived>& values, Layout layout = Layout::columns) {
    if (values.size() == 0) return;
    const View view = writable(static_cast<std::size_t>(values.size()));
    see_reals<Derived::ColsAtCompileTime>(view.data(), values.rows(), values.cols(), layout,
                                          [&](auto device) { convert(values.derived(), device); });
  }

  /// As many as `values` has room for.
  template <typename Derived>
  void download(Eigen::PlainObjectBase<Derived>& values, Layout layout = Layout::columns) const {
    if (values.size() == 0) return;
    const View view = readable(static_cast<std::size_t>(values.size()));
    see_reals<Derived::ColsAtCompileTime>(view.data(), values.rows(), values.cols(), layout,
                                          [&](const auto& device) { convert(device, values.derived()); });
  }

 private:
  template <int kColumns, typename Use>
  void see_reals(void* data, Eigen::Index rows, Eigen::Index columns, Layout layout, const Use& use) const {
    if (precision() == Precision::single) {
      see<float, kColumns>(data, rows, columns, layout, use);
    } else {
      see<double, kColumns>(data, rows, columns, layout, use);
    }
  }
};

/// Indices, flags and the like.
class Ints : public Buffer {
 public:
  Ints(const Queue& queue, Eigen::Index count);
  Ints(const Queue& queue, const std::vector<int>& list);

  template <typename Derived>
  Ints(const Queue& queue, const Eigen::DenseBase<Derived>& values, Layout layout = Layout::columns)
      : Ints(queue, values.size()) {
    upload(values, layout);
  }

  template <typename Derived>
  void upload(const Eigen::DenseBase<Derived>& values, Layout layout = Layout::columns) {
    if (values.size() == 0) return;
    const View view = writable(static_cast<std::size_t>(values.size()));
    see<int, Derived::ColsAtCompileTime>(view.data(), values.rows(), values.cols(), layout,
                                         [&](auto device) { convert(values.derived(), device); });
  }

  template <typename Derived>
  void download(Eigen::PlainObjectBase<Derived>& values, Layout layout = Layout::columns) const {
    if (values.size() == 0) return;
    const View view = readable(static_cast<std::size_t>(values.size()));
    see<int, Derived::ColsAtCompileTime>(view.data(), values.rows(), values.cols(), layout,
                                         [&](const auto& device) { convert(device, values.derived()); });
  }
};

}  // namespace swage
