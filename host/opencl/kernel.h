// Kernels and their launches.
#pragma once

#include <cstddef>
#include <string>

#include "buffer.h"
#include "host_rows.h"
#include "words.h"

namespace swage {

/// A kernel of kernels/<stem>.cl with its arguments. Its first argument is `const int count`: it gets as many work
/// items, rounded up to whole groups, and those from `count` on must return at once.
class Kernel {
 public:
  /// Throws Unavailable where the program does not build.
  Kernel(const Queue& queue, const std::string& stem, const std::string& name);
  Kernel(const Queue& queue, const cl::Program& program, const std::string& name);

  /// Arguments: Reals, Ints, HostRows, int, double for a kernel's `scalar` and HostNumber for its `host_scalar`. Does
  /// not wait. No element: no launch.
  template <typename... Arguments>
  void launch(Eigen::Index count, const Arguments&... arguments) {
    if (count == 0) return;
    ask("kernel arguments", [&] {
      cl_uint place = 0;
      set(place++, static_cast<int>(count));
      (set(place++, arguments), ...);
    });
    enqueue(static_cast<std::size_t>(count));
  }

 private:
  void set(cl_uint place, int value) { kernel_.setArg(place, value); }
  void set(cl_uint place, double value);
  void set(cl_uint place, HostNumber value);
  void set(cl_uint place, const Buffer& buffer) { kernel_.setArg(place, buffer.handle()); }
  void set(cl_uint place, const HostRows& rows) { kernel_.setArg(place, rows.handle()); }
  void enqueue(std::size_t count);

  Queue queue_;
  cl::Kernel kernel_;
};

}  // namespace swage
