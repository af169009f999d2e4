// A device at work: its programs (here), arrays (buffer.h) and kernels (kernel.h).
//
// How a step (opencl_steps.h) uses it:
//   Queue queue_;                                      // one a step, made from the shared context
//   Reals rest_{queue_, rest.vertices};                // static data goes up once
//   HostRows positions_{queue_, vertices * 3}, result_{queue_, count * 9};  // what a call brings (host_rows.h)
//   Kernel fit_{queue_, "rotation", "fit_rotations"};  // kernels/rotation.cl; (const int count, ...) its arguments
//   const Visit visit(queue_, {&positions_, &result_});
//   positions_.show(positions);
//   result_.lend(rotations);
//   fit_.launch(count, rest_, positions_, 0.5, result_);
//   result_.take_back(rotations);
#pragma once

#include <atomic>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "cl.h"
#include "kernel_source.h"
#include "program_cache.h"
#include "swage/backend.h"

namespace swage {

/// Threads may share it.
class Context {
 public:
  /// Throws Unavailable.
  Context(const cl::Device& device, Precision precision, ProgramCache cache);
  /// The same, with whether kernels see the host's arrays where they lie (host_rows.h).
  Context(const cl::Device& device, Precision precision, ProgramCache cache, bool in_host_memory);

  Precision precision() const { return precision_; }
  /// How many elements an item of kernels/<stem>.cl has, where that is written in lanes.
  int lanes(const std::string& stem) const;
  bool in_host_memory() const { return in_host_memory_; }
  const cl::Device& device() const { return device_; }
  const cl::Context& handle() const { return handle_; }

  /// kernels/<stem>.cl with what it includes, built the first time it is asked for. Throws Unavailable with the log.
  cl::Program program(const std::string& stem);

  /// The same with an element an item, on every device.
  cl::Program program_alone(const std::string& stem);

  /// The same of a text that stands in no file: `name` stands for it in messages.
  cl::Program program(const std::string& name, const std::string& text);

  /// Room for an array, until the last copy of what this gives is gone. Throws Unavailable where the device has not as
  /// much left: some allocate at first use only, and end the process there.
  std::shared_ptr<const std::size_t> claim(std::size_t bytes);

  void count_upload(std::size_t bytes) { uploaded_ += bytes; }
  void count_download(std::size_t bytes) { downloaded_ += bytes; }
  Traffic traffic() const;

 private:
  Arithmetic arithmetic(const std::string& stem) const;
  cl::Program build(const std::string& name, const std::string& source);
  cl::Program compile(const std::string& name, const std::string& source) const;
  void keep(const std::string& key, const cl::Program& program) const;

  cl::Device device_;
  Precision precision_;
  bool in_vectors_;
  bool in_host_memory_;
  cl::Context handle_;
  ProgramCache cache_;
  std::string options_;
  std::mutex mutex_;
  std::map<std::string, std::shared_future<cl::Program>> programs_;
  std::size_t memory_;
  std::atomic<std::size_t> claimed_{0}, uploaded_{0}, downloaded_{0};
  std::atomic<long long> build_nanoseconds_{0};
};

/// Work on a context, one thing after the other. A step has its own; its buffers and kernels share it.
struct Queue {
  explicit Queue(std::shared_ptr<Context> context);

  std::shared_ptr<Context> context;
  cl::CommandQueue handle;
};

}  // namespace swage
